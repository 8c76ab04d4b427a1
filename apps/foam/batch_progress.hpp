// What a person at a terminal sees of a batch.
#pragma once

#include <foam/batch/batch.hpp>

#include <string>

namespace foam::cli {

/// Returns a time span for people: "12 s", "3 min", "2.5 h", "4.1 days".
std::string span_text(double seconds);

/// A line on stderr, on a terminal only: meshes, failures, rate, time left.
class BatchProgressBar {
public:
    BatchProgressBar();
    void show(const BatchProgress& progress);
    void clear();

private:
    bool terminal_, drawn_ = false;
};

} // namespace foam::cli
