#include "archive.hpp"

#include <foam/batch/batch.hpp>

#include <foam/base/error.hpp>
#include <foam/base/file.hpp>
#include <foam/base/internal/files.hpp>
#include <foam/base/text.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <glob.h>
#include <iostream>
#include <iterator>
#include <set>

namespace foam::inline batch {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

const std::vector<std::string> known_keys{"id", "path", "scale", "unit", "spheres"};

/// The list that is read, for messages.
struct Place {
    std::string file;
    std::size_t line = 0;
};

[[noreturn]] void refuse_line(const Place& place, const std::string& why) {
    throw Error(ErrorCode::input, fmt::format("{}:{}: {}", place.file, place.line, why));
}

void require_known(const std::string& key, const Place& place) {
    if (std::find(known_keys.begin(), known_keys.end(), key) == known_keys.end()) {
        const std::string near = nearest_word(key, known_keys);
        refuse_line(place, fmt::format("unknown key '{}'{}; remedy: use {}, and keep other data in a list of your own, "
                                       "by id",
                                       shown(key), near.empty() ? "" : fmt::format("; did you mean '{}'?", near),
                                       fmt::join(known_keys, ", ")));
    }
}

/// Returns the path as a path of foam: absolute, without "..".
std::string absolute_in(const fs::path& folder, const std::string& path) {
    if (const auto inside = archive_path(path)) {
        return absolute_in(folder, inside->archive.string()) + "::" + inside->member;
    }
    return fs::absolute(folder / path).lexically_normal().string();
}

/// Returns a value as JSON; bytes that are not UTF-8 become marks.
std::string text_of(const Json& value) {
    return value.dump(-1, ' ', false, Json::error_handler_t::replace);
}

double number_of(const Json& value, const std::string& key, const Place& place) {
    const std::optional<double> number = value.is_number()   ? std::optional(value.get<double>())
                                         : value.is_string() ? parse_number(value.get<std::string>())
                                                             : std::nullopt;
    if (!number || !(*number > 0)) {
        refuse_line(place, fmt::format("'{}' must be a number above 0, not {}", key, text_of(value)));
    }
    return *number;
}

/// Returns the item of an object of a list.
BatchItem item_of(const Json& object, const fs::path& folder, const Place& place) {
    if (!object.is_object()) {
        refuse_line(place, "not a JSON object; remedy: write {\"id\": \"…\", \"path\": \"…\"}");
    }
    BatchItem item;
    for (const auto& [key, value] : object.items()) {
        require_known(key, place);
        if (key == "scale") {
            item.unit.scale = number_of(value, key, place);
        } else if (key == "spheres") {
            const double number = number_of(value, key, place);
            if (number != std::floor(number) || number > 1e6) {
                refuse_line(place, fmt::format("'spheres' must be an integer of 1 to 1000000, not {}", text_of(value)));
            }
            item.spheres = static_cast<std::size_t>(number);
        } else if (key == "id" && value.is_number_integer()) {
            item.id = value.dump();
        } else if (!value.is_string() || value.get<std::string>().empty()) {
            refuse_line(place, fmt::format("'{}' must be a text that is not empty, not {}", key, text_of(value)));
        } else if (value.get<std::string>().find('\0') != std::string::npos) {
            refuse_line(place, fmt::format("'{}' must not hold a zero byte", key));
        } else {
            (key == "id" ? item.id : key == "path" ? item.path : item.unit.unit.emplace()) = value.get<std::string>();
        }
    }
    if (item.path.empty()) {
        refuse_line(place, "no 'path'; remedy: give the mesh file, relative to the list");
    }
    try {
        item.unit.factor();
    } catch (const Error& error) {
        refuse_line(place, error.what());
    }
    item.id = item.id.empty() ? item.path : item.id;
    item.path = absolute_in(folder, item.path);
    return item;
}

/// Calls `on_line` with each line that is not empty, without its line end.
template <class OnLine> void for_lines(const std::string& text, Place& place, const OnLine& on_line) {
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        std::string line = text.substr(begin, end - begin);
        if (line.ends_with('\r')) {
            line.pop_back();
        }
        ++place.line;
        if (line.find_first_not_of(" \t") != std::string::npos) {
            on_line(line);
        }
        begin = end + 1;
    }
}

/// Returns the JSON of a line, in which no key stands twice.
Json object_of(const std::string& line, const Place& place) {
    std::set<std::string> keys;
    const auto on_event = [&](int depth, Json::parse_event_t event, Json& key) {
        if (event == Json::parse_event_t::key && depth == 1 && !keys.insert(key.get<std::string>()).second) {
            refuse_line(place, fmt::format("the key '{}' stands twice", shown(key.get<std::string>())));
        }
        return true;
    };
    Json object = Json::parse(line, on_event, false);
    if (object.is_discarded()) {
        refuse_line(place, "not JSON; remedy: write one object a line, {\"id\": \"…\", \"path\": \"…\"}");
    }
    return object;
}

std::vector<BatchItem> items_of_json_lines(const std::string& text, const fs::path& folder, Place place) {
    std::vector<BatchItem> items;
    for_lines(text, place, [&](const std::string& line) {
        const Json object = object_of(line, place);
        items.push_back(item_of(object, folder, place));
    });
    return items;
}

/// Returns the fields of a line of a table: RFC 4180, without line ends in fields.
std::vector<std::string> fields_of(const std::string& line, const Place& place) {
    std::vector<std::string> fields(1);
    bool quoted = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
        const char c = line[i];
        if (quoted && c == '"' && i + 1 < line.size() && line[i + 1] == '"') {
            fields.back() += line[++i];
        } else if (c == '"' && (quoted || fields.back().empty())) {
            quoted = !quoted;
        } else if (c == ',' && !quoted) {
            fields.emplace_back();
        } else {
            fields.back() += c;
        }
    }
    if (quoted) {
        refuse_line(place, "a quotation mark is not closed");
    }
    return fields;
}

std::vector<BatchItem> items_of_table(const std::string& text, const fs::path& folder, Place place) {
    std::vector<BatchItem> items;
    std::vector<std::string> columns;
    for_lines(text, place, [&](const std::string& line) {
        const std::vector<std::string> fields = fields_of(line, place);
        if (columns.empty()) {
            for (const std::string& key : fields) {
                require_known(key, place);
                if (std::find(columns.begin(), columns.end(), key) != columns.end()) {
                    refuse_line(place, fmt::format("the column '{}' stands twice", key));
                }
                columns.push_back(key);
            }
            return;
        }
        if (fields.size() != columns.size()) {
            refuse_line(place, fmt::format("{} fields for {} columns", fields.size(), columns.size()));
        }
        Json object = Json::object();
        for (std::size_t i = 0; i < fields.size(); ++i) {
            if (!fields[i].empty()) {
                object[columns[i]] = fields[i];
            }
        }
        items.push_back(item_of(object, folder, place));
    });
    return items;
}

std::vector<BatchItem> items_of_text(const std::string& text, const fs::path& folder, Place place) {
    std::vector<BatchItem> items;
    for_lines(text, place, [&](const std::string& line) { items.push_back(item_of({{"path", line}}, folder, place)); });
    return items;
}

bool is_mesh_name(const std::string& name, const Registry& registry) {
    return registry.find_for_extension(StageKind::mesh_loader, extension_of(name)) != nullptr;
}

/// Calls `on_file` with all that is no folder, also behind links; a link to a folder that contains it is not followed.
void for_files_in(const fs::path& folder, const std::function<void(const fs::path&)>& on_file) {
    std::vector<fs::path> within{fs::canonical(folder)}; // the folders that contain the current entry
    const auto options = fs::directory_options::follow_directory_symlink;
    for (fs::recursive_directory_iterator entry(folder, options), end; entry != end; ++entry) {
        std::error_code broken_link;
        if (!entry->is_directory(broken_link)) {
            on_file(entry->path()); // a file that cannot be read becomes a failure with a name
            continue;
        }
        within.resize(static_cast<std::size_t>(entry.depth()) + 1);
        within.push_back(fs::canonical(entry->path()));
        if (std::find(within.begin(), within.end() - 1, within.back()) != within.end() - 1) {
            entry.disable_recursion_pending();
        }
    }
}

std::vector<BatchItem> items_of_folder(const fs::path& folder, const Registry& registry) {
    std::vector<BatchItem> items;
    try {
        for_files_in(folder, [&](const fs::path& file) {
            const std::string inside = file.lexically_relative(folder).string();
            if (is_mesh_name(inside, registry)) {
                items.push_back({inside, absolute_in(fs::current_path(), file.string()), {}, {}});
            }
        });
    } catch (const fs::filesystem_error& error) {
        throw Error(ErrorCode::input,
                    fmt::format("{}: it cannot be read whole ({}: {}); remedy: a list of the files that "
                                "can be read",
                                folder.string(), error.path1().string(), error.code().message()));
    }
    return items;
}

std::vector<BatchItem> items_of_archive(const fs::path& file, const Registry& registry) {
    std::vector<BatchItem> items;
    for (const ArchiveMember& member : open_archive(file)->members()) {
        if (is_mesh_name(member.name, registry)) {
            items.push_back({member.name, absolute_in(fs::current_path(), file.string()) + "::" + member.name, {}, {}});
        }
    }
    return items;
}

std::vector<BatchItem> items_of_glob(const std::string& pattern) {
    glob_t found{};
    const int code = glob(pattern.c_str(), 0, nullptr, &found);
    std::vector<BatchItem> items;
    for (std::size_t i = 0; code == 0 && i < found.gl_pathc; ++i) {
        items.push_back({found.gl_pathv[i], absolute_in(fs::current_path(), found.gl_pathv[i]), {}, {}});
    }
    globfree(&found);
    return items;
}

std::vector<BatchItem> items_of(const std::string& source, const Registry& registry) {
    const fs::path file = source;
    std::error_code error;
    if (source == "-") {
        const std::string text{std::istreambuf_iterator<char>(std::cin), {}};
        return items_of_json_lines(text, fs::current_path(), {"standard input"});
    }
    if (fs::is_directory(file, error)) {
        return items_of_folder(file, registry);
    }
    if (!fs::exists(file, error) && source.find_first_of("*?[") != std::string::npos) {
        return items_of_glob(source);
    }
    if (fs::exists(file, error) && is_archive(file)) {
        return items_of_archive(file, registry);
    }
    std::string text = read_file(file);
    const std::string extension = extension_of(file);
    constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF"; // by which spreadsheets begin UTF-8
    text.erase(0, text.starts_with(byte_order_mark) ? byte_order_mark.size() : 0);
    const fs::path folder = fs::absolute(file).parent_path();
    if (extension == "jsonl" || extension == "ndjson") {
        return items_of_json_lines(text, folder, {source});
    }
    if (extension == "csv") {
        return items_of_table(text, folder, {source});
    }
    if (extension == "txt") {
        return items_of_text(text, folder, {source});
    }
    throw Error(ErrorCode::input, fmt::format("{}: not a list of meshes; remedy: a .jsonl, .csv or .txt, a folder, an "
                                              "archive (.zip, .tar), a glob in quotes, or - for the standard input",
                                              source));
}

void require_utf8(const std::string& source, const std::string& text) {
    try {
        Json(text).dump();
    } catch (const Json::exception&) {
        throw Error(ErrorCode::input,
                    fmt::format("{}: '{}' is not UTF-8, which results are; remedy: rename it", source, shown(text)));
    }
}

} // namespace

std::vector<BatchItem> read_batch_list(const std::string& source, const Registry& registry) {
    std::vector<BatchItem> items = items_of(source, registry);
    for (const BatchItem& item : items) {
        require_utf8(source, item.id);
        require_utf8(source, item.path);
    }
    if (items.empty()) {
        throw Error(ErrorCode::input, fmt::format("{}: no mesh in it", source));
    }
    const auto by_id = [](const BatchItem& a, const BatchItem& b) { return a.id < b.id; };
    std::sort(items.begin(), items.end(), by_id);
    const auto twice = std::adjacent_find(items.begin(), items.end(),
                                          [](const BatchItem& a, const BatchItem& b) { return a.id == b.id; });
    if (twice != items.end()) {
        throw Error(ErrorCode::input,
                    fmt::format("{}: the id '{}' occurs twice; remedy: give each mesh an id of its own", source,
                                shown(twice->id)));
    }
    return items;
}

} // namespace foam::batch
