// Tables on the terminal.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <string_view>

namespace foam::cli {

/// What a column needs that holds `text` and a member of each row.
template <class Rows, class Member> std::size_t column_width(std::string_view text, const Rows& rows, Member member) {
    std::size_t width = text.size();
    for (const auto& row : rows) {
        width = std::max(width, std::invoke(member, row).size());
    }
    return width;
}

} // namespace foam::cli
