#include "table.hpp"

#include <foam/base/error.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace foam::inline bench::experiment {
namespace {

std::string csv_cell(const std::string& text) {
    if (text.find_first_of(",\"\r\n") == text.npos) {
        return text;
    }
    std::string quoted(1, '"');
    for (const char c : text) {
        quoted.append(c == '"' ? 2 : 1, c);
    }
    quoted += '"';
    return quoted;
}

std::string csv_line(const std::vector<std::string>& cells) {
    std::string line;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        line += i > 0 ? "," : "";
        line += csv_cell(cells[i]);
    }
    line += '\n';
    return line;
}

std::string markdown_line(const std::vector<std::string>& cells) {
    std::string line(1, '|');
    for (const std::string& cell : cells) {
        line += ' ';
        for (const char c : cell) {
            if (c == '|') {
                line += '\\';
            }
            line += c;
        }
        line += " |";
    }
    line += '\n';
    return line;
}

/// Cell by cell through a text.
class CsvReader {
public:
    CsvReader(std::string_view text, const std::string& source) : text_(text), source_(source) {}

    bool at_end() const { return at_ >= text_.size(); }

    std::vector<std::string> line() {
        std::vector<std::string> cells;
        do {
            cells.push_back(cell());
        } while (take(','));
        take('\r');
        take('\n');
        ++line_;
        return cells;
    }

    [[noreturn]] void fail(const std::string& why) const {
        throw Error(ErrorCode::input, fmt::format("{}:{}: {}", source_, line_, why));
    }

private:
    bool take(char c) {
        const bool there = !at_end() && text_[at_] == c;
        at_ += there ? 1 : 0;
        return there;
    }

    std::string cell() {
        if (!take('"')) {
            const std::size_t begin = at_;
            at_ = std::min(text_.find_first_of(",\r\n", at_), text_.size());
            return std::string(text_.substr(begin, at_ - begin));
        }
        std::string result;
        for (;; ++at_) {
            if (at_end()) {
                fail("a quote does not end");
            }
            if (take('"') && (at_end() || text_[at_] != '"')) {
                return result;
            }
            result += text_[at_]; // of a doubled quote the second
        }
    }

    std::string_view text_;
    const std::string& source_;
    std::size_t at_ = 0, line_ = 1;
};

} // namespace

std::string to_csv(const Table& table) {
    std::string text = csv_line(table.columns);
    for (const auto& row : table.rows) {
        text += csv_line(row);
    }
    return text;
}

Table parse_csv(std::string_view text, const std::string& source) {
    CsvReader reader(text, source);
    Table table;
    table.columns = reader.line();
    while (!reader.at_end()) {
        std::vector<std::string> row = reader.line();
        if (row.size() != table.columns.size()) {
            throw Error(ErrorCode::input, fmt::format("{}: line {} has {} cells, the first {}", source,
                                                      table.rows.size() + 2, row.size(), table.columns.size()));
        }
        table.rows.push_back(std::move(row));
    }
    return table;
}

std::string to_markdown(const Table& table) {
    std::string text = markdown_line(table.columns);
    text += '|';
    for (std::size_t i = 0; i < table.columns.size(); ++i) {
        text += i == 0 ? "---|" : "---:|";
    }
    text += "\n";
    for (const auto& row : table.rows) {
        text += markdown_line(row);
    }
    return text;
}

} // namespace foam::bench::experiment
