#include <foam/yaml/write.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace foam::yaml {
namespace {

constexpr TextKind robot_file{.name = "file", .most_bytes = 64'000'000};

std::size_t line_end(std::string_view text, std::size_t at) {
    return std::min(text.find('\n', at), text.size());
}

/// Returns the number of blanks at the beginning of the line; npos for an empty line and a comment.
std::size_t indent_of(std::string_view line) {
    const std::size_t first = line.find_first_not_of(" \r");
    return first == line.npos || line[first] == '#' ? line.npos : first;
}

} // namespace

Splice::Splice(std::string text, std::string name, ErrorCode code)
    : text_(std::move(text)), name_(std::move(name)), code_(code) {
    parse();
    if (!root_.is(Value::Kind::map)) {
        fail(root_.where, fmt::format("a map of keys is expected, got {}", root_.description()));
    }
}

void Splice::parse() {
    root_ = tree_of(text_, name_, robot_file, code_);
}

void Splice::fail(const Place& where, const std::string& what) const {
    throw Error(code_, fmt::format("{}:{}:{}: {}", name_, where.line, where.column, what));
}

std::size_t Splice::offset_of(const Place& place) const {
    std::size_t at = 0;
    for (int line = 1; line < place.line; ++line) {
        at = std::min(line_end(text_, at) + 1, text_.size());
    }
    for (int column = 1; column < place.column && at < text_.size(); ++column) {
        do {
            ++at;
        } while (at < text_.size() && (static_cast<unsigned char>(text_[at]) & 0xC0U) == 0x80U);
    }
    return at;
}

const Value* Splice::find(const std::vector<std::string_view>& path) const {
    const Value* value = &root_;
    for (const std::string_view key : path) {
        value = value->is(Value::Kind::map) ? value->find(key) : nullptr;
        if (!value) {
            return nullptr;
        }
    }
    return value;
}

/// Returns the end of a scalar or of a collection in brackets.
std::size_t Splice::end_of_flow(std::size_t begin, const Place& where) const {
    int open = 0;
    char quote = 0;
    for (std::size_t i = begin; i < text_.size(); ++i) {
        const char c = text_[i];
        if (quote) {
            if (c == '\\' && quote == '"') {
                ++i;
            } else if (c == quote) {
                quote = 0;
                if (open == 0) {
                    return i + 1;
                }
            }
        } else if ((c == '"' || c == '\'') && (i == begin || open > 0)) {
            quote = c;
        } else if (c == '#' && i > 0 && (text_[i - 1] == ' ' || text_[i - 1] == '\n')) {
            if (open == 0) {
                return text_.find_last_not_of(" \t", i - 1) + 1;
            }
            i = line_end(text_, i);
        } else if (c == '{' || c == '[') {
            ++open;
        } else if (c == '}' || c == ']') {
            if (open == 0) {
                return text_.find_last_not_of(" \t\n", i - 1) + 1; // the end of the map around it
            }
            if (--open == 0) {
                return i + 1;
            }
        } else if (open == 0 && c == '\n') {
            return text_.find_last_not_of(" \t\r", i - 1) + 1;
        } else if (open == 0 && c == ',' && text_[begin] != '"' && text_[begin] != '\'') {
            const bool separates = i + 1 == text_.size() || text_[i + 1] == ' ' || text_[i + 1] == '\n';
            if (separates && begin > 0) {
                const std::size_t line = text_.rfind('\n', begin) + 1;
                if (text_.substr(line, begin - line).find_first_of("{[") != std::string::npos) {
                    return i;
                }
            }
        }
    }
    if (open > 0 || quote) {
        fail(where, "the end of this value was not found");
    }
    return text_.size();
}

/// Returns the end of the lines that are indented more than the key; of a list also those at its column that begin with
/// "- ".
std::size_t Splice::end_of_block(std::size_t line_after_key, std::size_t column, bool list) const {
    std::size_t end = line_after_key;
    for (std::size_t at = line_after_key; at < text_.size();) {
        const std::size_t next = std::min(line_end(text_, at) + 1, text_.size());
        const std::string_view line = std::string_view(text_).substr(at, line_end(text_, at) - at);
        const std::size_t indent = indent_of(line);
        if (indent != line.npos) {
            const bool item = list && indent == column && line.substr(indent).starts_with("-");
            if (indent <= column && !item) {
                break;
            }
            end = next;
        }
        at = next;
    }
    return end;
}

void Splice::replace(const Value& map, std::size_t index, const Value& value, bool in_flow) {
    const Key& key = map.keys[index];
    const Value& old = map.items[index];
    const std::size_t at_key = offset_of(key.where);
    const std::size_t column = at_key == 0 || text_.rfind('\n', at_key - 1) == std::string::npos
                                   ? at_key
                                   : at_key - (text_.rfind('\n', at_key - 1) + 1);
    const std::size_t begin = offset_of(old.where);
    const bool nothing = old.is(Value::Kind::null) && (begin >= text_.size() || begin == at_key ||
                                                       std::string_view("~nN").find(text_[begin]) == std::string::npos);
    const bool flow = old.is_scalar() || text_[std::min(begin, text_.size() - 1)] == '{' || text_[begin] == '[';
    if (nothing) {
        fail(key.where, fmt::format("'{}' has no value; remedy: write {}: {{}}", key.text, key.text));
    }
    if (flow) {
        const std::size_t end = end_of_flow(begin, old.where);
        text_.replace(begin, end - begin, flow_text(value));
    } else if (in_flow) {
        fail(key.where, "a value of many lines within brackets cannot be replaced");
    } else {
        const std::size_t lines = std::min(line_end(text_, at_key) + 1, text_.size());
        const std::size_t end = end_of_block(lines, column, old.is(Value::Kind::list));
        const bool empty = value.items.empty() || value.is_scalar();
        if (empty) {
            const std::size_t colon = line_end(text_, at_key);
            text_.replace(colon, end - colon, fmt::format(" {}\n", flow_text(value)));
        } else {
            text_.replace(lines, end - lines, block_text(value, column + 2));
        }
    }
    parse();
}

void Splice::add(const Value& map, std::string_view key, const Value& value) {
    if (map.where.line > 0 && text_[std::min(offset_of(map.where), text_.size() - 1)] == '{') {
        append_in_flow(map, fmt::format("{}: {}", scalar_text(key), flow_text(value)));
        return;
    }
    if (map.keys.empty()) {
        fail(map.where, fmt::format("there is no key '{}'; remedy: add {}: {{}}", key, key));
    }
    const Key& last = map.keys.back();
    const std::size_t at = offset_of(last.where);
    const std::size_t before = at == 0 ? std::string::npos : text_.rfind('\n', at - 1);
    const std::size_t column = before == std::string::npos ? at : at - before - 1;
    if (!text_.ends_with('\n')) {
        text_ += '\n';
    }
    const std::size_t lines = std::min(line_end(text_, at) + 1, text_.size());
    const std::size_t end = end_of_block(lines, column, map.items.back().is(Value::Kind::list));
    std::string entry = block_text(yaml::map({{std::string(key), value}}), column);
    if (entry[column] == '{') { // the whole map on one line
        entry = fmt::format("{}{}: {}\n", std::string(column, ' '), scalar_text(key), flow_text(value));
    }
    text_.insert(end, entry);
    parse();
}

/// Puts an item behind the last one of a collection in brackets.
void Splice::append_in_flow(const Value& collection, const std::string& item) {
    const std::size_t bracket = end_of_flow(offset_of(collection.where), collection.where) - 1;
    const std::size_t begin = collection.items.empty() ? bracket : offset_of(collection.items.back().where);
    std::size_t end = begin; // of the last item, with a comma behind it
    char quote = 0;
    for (std::size_t i = begin; i < bracket; ++i) {
        const char c = text_[i];
        const bool after_blank = i == begin || std::string_view(" \t\r\n,:[{").find(text_[i - 1]) != std::string::npos;
        if (quote) {
            i += c == '\\' && quote == '"' ? 1 : 0;
            quote = c == quote ? '\0' : quote;
        } else if (c == '#' && after_blank) {
            i = line_end(text_, i);
            continue;
        } else if ((c == '"' || c == '\'') && after_blank) {
            quote = c;
        }
        end = std::string_view(" \t\r\n").find(c) == std::string::npos ? i + 1 : end;
    }
    text_.insert(end, (collection.items.empty() ? "" : text_[end - 1] == ',' ? " " : ", ") + item);
    parse();
}

void Splice::extend(const std::vector<std::string_view>& path, const Value& items) {
    const Value* list = find(path);
    if (!list || list->is(Value::Kind::null)) {
        set(path, items);
        return;
    }
    if (!list->is(Value::Kind::list)) {
        fail(list->where, fmt::format("a list is expected, got {}", list->description()));
    }
    for (const Value& item : items.items) {
        list = find(path);
        if (text_[offset_of(list->where)] == '[') {
            append_in_flow(*list, flow_text(item));
            continue;
        }
        const std::size_t at = offset_of(list->items.back().where);
        const std::size_t line = at == 0 ? 0 : text_.rfind('\n', at - 1) + 1;
        const std::size_t dash = text_.find_first_not_of(' ', line);
        if (text_[dash] != '-') {
            fail(list->where, "this list cannot be extended; remedy: one item a line");
        }
        const std::size_t end = line_end(text_, at);
        text_.insert(end, fmt::format("\n{}- {}", std::string(dash - line, ' '), flow_text(item)));
        parse();
    }
}

void Splice::set(const std::vector<std::string_view>& path, const Value& value) {
    const Value* map = find({path.begin(), path.end() - 1});
    if (!map || !map->is(Value::Kind::map)) {
        fail(root_.where, fmt::format("there is no map '{}'", fmt::join(path.begin(), path.end() - 1, ".")));
    }
    const auto key = std::find_if(map->keys.begin(), map->keys.end(),
                                  [&](const Key& candidate) { return candidate.text == path.back(); });
    if (key == map->keys.end()) {
        add(*map, path.back(), value);
    } else {
        const std::size_t at = offset_of(map->where);
        replace(*map, static_cast<std::size_t>(key - map->keys.begin()), value, at < text_.size() && text_[at] == '{');
    }
}

} // namespace foam::yaml
