// Tables on the terminal.
#pragma once

#include <foam/base/text.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <string>
#include <string_view>

namespace foam::cli {

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

} // namespace foam::cli
