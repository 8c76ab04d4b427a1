// The context of a writer that the program calls itself.
#pragma once

#include "cli/program.hpp"

#include <foam/sdk/context.hpp>

#include <fmt/format.h>

namespace foam::cli {

/// Tells what a writer warns of.
class Telling final : public QuietContext {
public:
    void log(Severity severity, std::string_view message) override {
        if (severity >= Severity::warning) {
            tell(fmt::format("warning: {}", message));
        }
    }
};

} // namespace foam::cli
