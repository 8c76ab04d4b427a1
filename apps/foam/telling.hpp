// The context of a writer that the program calls itself.
#pragma once

#include "cli/program.hpp"

#include <foam/sdk/context.hpp>

#include <fmt/format.h>

namespace foam::cli {

/// Tells what a writer warns of. `verbose`: also its notes.
class Telling final : public QuietContext {
public:
    explicit Telling(bool verbose = false) : verbose_(verbose) {}
    void log(Severity severity, std::string_view message) override {
        if (severity >= Severity::warning) {
            tell(fmt::format("warning: {}", message));
        } else if (verbose_ && severity == Severity::info) {
            tell(fmt::format("note: {}", message));
        }
    }

private:
    bool verbose_;
};

} // namespace foam::cli
