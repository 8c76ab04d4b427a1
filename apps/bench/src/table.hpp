// Tables of texts, as CSV and as Markdown.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace foam::inline bench::experiment {

struct Table {
    std::vector<std::string> columns;
    std::vector<std::vector<std::string>> rows; ///< as many cells as columns
};

/// RFC 4180, with '\n' at the ends of lines; quotes only where they are needed.
std::string to_csv(const Table& table);
/// The first line names the columns. Throws Error(input), naming `source`, for a row of another length or a quote that
/// does not end.
Table parse_csv(std::string_view text, const std::string& source);

/// The first column to the left, the others to the right.
std::string to_markdown(const Table& table);

} // namespace foam::bench::experiment
