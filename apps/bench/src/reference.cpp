#include "reference.hpp"

#include "table.hpp"

#include <foam/base/error.hpp>
#include <foam/base/internal/files.hpp>
#include <foam/base/text.hpp>
#include <foam/recipe/internal/yaml.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

namespace foam::inline bench::experiment {
namespace {

using namespace reading;
namespace fs = std::filesystem;

constexpr const char* example = "references: [{label: …, file: FILE.csv, x: COLUMN, y: COLUMN}]";

std::string read_word(const Value& map, const char* key, Findings& findings) {
    const Value* value = map.find(key);
    if (!value) {
        findings.error(map.where, "missing-key", fmt::format("a reference needs '{}'; remedy: write {}", key, example));
        return "";
    }
    const auto text = read_value(*value, Parameter::text(key, ""), "a reference", findings);
    return text ? std::get<std::string>(*text) : "";
}

Reference read_one(const Value& item, Findings& findings) {
    Reference reference;
    if (!expect_map(item, "references", example, findings)) {
        return reference;
    }
    refuse_unknown_keys(item, "a reference", {"label", "file", "where", "x", "y"}, findings);
    reference.label = read_word(item, "label", findings);
    reference.x = read_word(item, "x", findings);
    reference.y = read_word(item, "y", findings);
    if (const Value* file = item.find("file")) {
        reference.files = read_references(*file, "file", findings);
    } else {
        findings.error(item.where, "missing-key", fmt::format("a reference needs 'file'; remedy: write {}", example));
    }
    if (const Value* where = item.find("where");
        where && expect_map(*where, "where", "where: {column: text}", findings)) {
        for (std::size_t i = 0; i < where->keys.size(); ++i) {
            reference.where[where->keys[i].text] = where->items[i].text; // as written, whatever its kind
        }
    }
    return reference;
}

std::size_t column(const Table& table, const std::string& name, const fs::path& file) {
    const auto it = std::find(table.columns.begin(), table.columns.end(), name);
    if (it == table.columns.end()) {
        throw Error(ErrorCode::input, fmt::format("{}: there is no column {}{}", file.string(), in_quotes(name),
                                                  suggestion(name, table.columns)));
    }
    return static_cast<std::size_t>(it - table.columns.begin());
}

double number_in(const std::string& cell, const std::string& name, const fs::path& file) {
    const auto value = parse_number(cell);
    if (!value) {
        throw Error(ErrorCode::input,
                    fmt::format("{}: column {} holds {}, no number", file.string(), in_quotes(name), in_quotes(cell)));
    }
    return *value;
}

} // namespace

std::vector<Reference> read_reference_list(const Value& value, Findings& findings) {
    std::vector<Reference> references;
    if (expect_list(value, "references", example, findings)) {
        for (const Value& item : value.items) {
            references.push_back(read_one(item, findings));
        }
    }
    return references;
}

fs::path find_reference(const Reference& reference, const fs::path& experiment) {
    std::vector<fs::path> folders{fs::absolute(experiment).parent_path()};
    if (const char* shared = std::getenv("FOAM_SHARED"); shared && *shared) {
        folders.emplace_back(shared);
    }
    std::error_code ignored;
    for (const std::string& file : reference.files) {
        for (const fs::path& folder : folders) {
            if (fs::is_regular_file(folder / file, ignored)) {
                return folder / file;
            }
        }
    }
    return {};
}

std::vector<std::pair<double, double>> load_reference(const Reference& reference, const fs::path& file) {
    const Table table = parse_csv(read_file(file), file.string());
    const std::size_t x = column(table, reference.x, file), y = column(table, reference.y, file);
    std::vector<std::pair<std::size_t, std::string>> conditions;
    for (const auto& [name, text] : reference.where) {
        conditions.emplace_back(column(table, name, file), text);
    }
    std::vector<std::pair<double, double>> points;
    for (const auto& row : table.rows) {
        if (std::all_of(conditions.begin(), conditions.end(),
                        [&](const auto& c) { return row[c.first] == c.second; })) {
            points.emplace_back(number_in(row[x], reference.x, file), number_in(row[y], reference.y, file));
        }
    }
    std::sort(points.begin(), points.end());
    return points;
}

} // namespace foam::bench::experiment
