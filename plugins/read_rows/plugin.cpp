// read.rows: tables of numbers without a header, GPMP2's "link_id x y z r" and plain "x y z r".
#include <foam/base/error.hpp>
#include <foam/base/text.hpp>
#include <foam/sdk/plugin.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace foam {
namespace {

/// Returns the line without a comment, and with spaces instead of commas.
std::string row_of(std::string_view line) {
    std::string row(line.substr(0, line.find_first_of("#%")));
    std::replace(row.begin(), row.end(), ',', ' ');
    return row;
}

void read_rows(const std::string& text, SphereFile& result) {
    std::string_view rest = text;
    rest.remove_prefix(rest.starts_with("\xEF\xBB\xBF") ? 3 : 0);
    std::size_t columns = 0;
    for (int line = 1; !rest.empty(); ++line) {
        const std::size_t end = std::min(rest.find('\n'), rest.size());
        const std::string row = row_of(rest.substr(0, end));
        rest.remove_prefix(std::min(end + 1, rest.size()));
        const std::vector<std::string_view> fields = words(row);
        if (fields.empty()) {
            continue;
        }
        const auto fail = [&](const std::string& why) {
            throw Error(ErrorCode::input, fmt::format("{}:{}: {}", result.file.string(), line, shown(why)));
        };
        if (fields.size() != 4 && fields.size() != 5) {
            fail(fmt::format("a row of {} fields; expected are x y z radius, or link x y z radius", fields.size()));
        }
        if (columns != 0 && fields.size() != columns) {
            fail(fmt::format("a row of {} fields after rows of {}; remedy: give all rows the same", fields.size(),
                             columns));
        }
        columns = fields.size();
        std::array<double, 4> numbers{};
        for (std::size_t i = 0; i < 4; ++i) {
            const std::string_view field = fields[columns - 4 + i];
            const std::optional<double> value = parse_number(field);
            if (!value) {
                fail(fmt::format("'{}' is not a finite number", field));
            }
            numbers[i] = *value;
        }
        spheres_of(result, columns == 5 ? std::string(fields[0]) : "")
            .push_back({{numbers[0], numbers[1], numbers[2]}, numbers[3]});
    }
    if (columns == 0) {
        throw Error(ErrorCode::input, fmt::format("{}: there is no row of numbers", result.file.string()));
    }
    result.format = columns == 5 ? "GPMP2 rows" : "rows of numbers";
}

/// Returns the first line that is neither blank nor a comment.
std::string_view first_row(std::string_view text) {
    for (;;) {
        text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
        const std::string_view line = text.substr(0, text.find('\n'));
        if (line.empty() || (line.front() != '%' && line.front() != '#')) {
            return line;
        }
        text.remove_prefix(line.size());
    }
}

class RowReader final : public ModelReader {
public:
    bool recognises(std::string_view text) const override {
        const std::string_view line = first_row(text);
        if (line.find_first_of(":{[<\"") != std::string_view::npos) {
            return false;
        }
        const std::string row = row_of(line);
        const std::vector<std::string_view> fields = words(row);
        return std::count_if(fields.begin(), fields.end(), [](std::string_view word) { return parse_number(word); }) >=
               3;
    }

    SphereFile read(const std::string& text, const std::filesystem::path& file, Context&) const override {
        SphereFile result;
        result.file = file;
        read_rows(text, result);
        return result;
    }
};

} // namespace
} // namespace foam

FOAM_PLUGIN("read_rows", "1.0", "Apache-2.0") {
    enrol.add<foam::RowReader>(
        {.name = "read.rows",
         .summary = "Reads rows of numbers, separated by blanks or commas: x y z radius, or link x y z radius (GPMP2).",
         .reference = "https://github.com/borglab/gpmp2 (robot models, BodySphere)"});
}
