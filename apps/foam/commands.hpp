// The commands, and what they print.
#pragma once

#include "cli/program.hpp"

#include <foam/base/text.hpp>
#include <foam/sdk/context.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <string>
#include <string_view>

namespace foam::cli {

void add_run(Program& program);
void add_check(Program& program);
void add_plan(Program& program);
void add_spherize(Program& program);
void add_approximate(Program& program);
void add_batch(Program& program);
void add_verify(Program& program);
void add_bench(Program& program);
void add_evaluate(Program& program);
void add_certify(Program& program);
void add_compare(Program& program);
void add_view(Program& program);
void add_gallery(Program& program);
void add_convert(Program& program);
void add_formats(Program& program);
void add_self_collision(Program& program);
void add_stages(Program& program);
void add_describe(Program& program);
void add_plugins(Program& program);
void add_cache(Program& program);
void add_schema(Program& program);
void add_sdk(Program& program);
void add_new_plugin(Program& program);
void add_test_plugin(Program& program);
void add_version(Program& program);
void add_info(Program& program);
void add_help(Program& program);
void add_completion(Program& program);
void add_manual(Program& program);

/// What a column needs that holds `text` and a member of each row, as padded() shows it.
template <class Rows, class Member> std::size_t column_width(std::string_view text, const Rows& rows, Member member) {
    std::size_t width = text.size();
    for (const auto& row : rows) {
        width = std::max(width, shown_width(shown(std::invoke(member, row))));
    }
    return width;
}

/// Returns a figure with so many digits behind the point; one of a million and more with four digits in all, so that it
/// stays in its column; "inf" for what has no end.
inline std::string figure_text(double value, int digits) {
    constexpr double too_wide = 1e6;
    return !std::isfinite(value)           ? "inf"
           : std::abs(value) >= too_wide ? fmt::format("{:.4g}", value)
                                           : fmt::format("{:.{}f}", value, digits);
}

/// A name, fit for the terminal, with spaces up to the width of its column.
inline std::string padded(std::string_view name, std::size_t width) {
    std::string text = shown(name);
    return text.append(width - std::min(width, shown_width(text)), ' ');
}

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
