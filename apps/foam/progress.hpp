// What a person at a terminal sees of a run: a bar, and findings as they come.
#pragma once

#include <foam/runtime/run.hpp>

#include <string>

namespace foam::cli {

/// On stderr: the size of the input first. The bar is drawn on a terminal only; warnings and errors always, notes if
/// `verbose`. `quiet`: warnings and errors alone.
class Progress final : public Observer {
public:
    explicit Progress(bool verbose, bool quiet = false);
    ~Progress() override;
    void on(const Event& event) override;

private:
    void draw(const Event& event);
    void clear();

    bool verbose_, quiet_, terminal_, drawn_ = false;
    double last_drawn_ = -1;
    std::string task_;
};

} // namespace foam::cli
