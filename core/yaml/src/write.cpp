#include <foam/base/text.hpp>
#include <foam/yaml/write.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace foam::yaml {
namespace {

Value node(Value::Kind kind) {
    Value value;
    value.kind = kind;
    return value;
}

template <class Item, class Make> Value list_of(const std::vector<Item>& items, Make make) {
    Value result = node(Value::Kind::list);
    for (const Item& item : items) {
        result.items.push_back(make(item));
    }
    return result;
}

bool is_plain(std::string_view text) {
    constexpr std::array<std::string_view, 14> words{"null", "true", "false", "yes", "no",  "on", "off",
                                                     "y",    "n",    "inf",   "nan", "none", "~",  ""};
    const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; };
    const auto inner = [&](char c) { return letter(c) || (c >= '0' && c <= '9') || c == '.' || c == '/' || c == '-'; };
    return !text.empty() && (letter(text.front()) || text.front() == '/') &&
           std::all_of(text.begin(), text.end(), inner) &&
           std::find(words.begin(), words.end(), lower_case(text)) == words.end();
}

/// Returns the number of collections within each other.
int depth_of(const Value& value) {
    int deepest = 0;
    for (const Value& item : value.items) {
        deepest = std::max(deepest, depth_of(item));
    }
    return value.is_scalar() ? 0 : deepest + 1;
}

bool is_on_one_line(const Value& value) {
    return depth_of(value) <= (value.is(Value::Kind::map) ? 2 : 1) || value.items.empty();
}

void add_block(std::string& text, const Value& value, std::size_t indent) {
    const std::string blanks(indent, ' ');
    if (is_on_one_line(value)) {
        text += blanks + flow_text(value) + "\n";
        return;
    }
    for (std::size_t i = 0; i < value.items.size(); ++i) {
        const Value& item = value.items[i];
        if (value.is(Value::Kind::list)) {
            std::string lines;
            add_block(lines, item, indent + 2);
            lines[indent] = '-';
            text += lines;
        } else if (is_on_one_line(item)) {
            text += blanks + scalar_text(value.keys[i].text) + ": " + flow_text(item) + "\n";
        } else {
            text += blanks + scalar_text(value.keys[i].text) + ":\n";
            add_block(text, item, indent + 2);
        }
    }
}

std::string json_string(std::string_view text) {
    std::string result = "\"";
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (c == '"' || c == '\\') {
            result += '\\';
            result += c;
        } else if (byte < 0x20) {
            result += fmt::format("\\u{:04x}", byte);
        } else {
            result += c;
        }
    }
    return result + '"';
}

/// Adds JSON; `lines`: not on one line.
void add_json(std::string& text, const Value& value, std::size_t indent) {
    if (value.is_scalar()) {
        text += value.is(Value::Kind::text) ? json_string(value.text) : flow_text(value);
        return;
    }
    const bool map = value.is(Value::Kind::map), lines = !is_on_one_line(value);
    text += map ? '{' : '[';
    for (std::size_t i = 0; i < value.items.size(); ++i) {
        text += i > 0 ? (lines ? "," : ", ") : "";
        text += lines ? "\n" + std::string(indent + 2, ' ') : "";
        text += map ? json_string(value.keys[i].text) + ": " : "";
        add_json(text, value.items[i], indent + 2);
    }
    text += lines ? "\n" + std::string(indent, ' ') : "";
    text += map ? '}' : ']';
}

} // namespace

Value null() {
    return node(Value::Kind::null);
}

Value boolean(bool value) {
    Value result = node(Value::Kind::boolean);
    result.flag = value;
    return result;
}

Value integer(std::int64_t value) {
    Value result = node(Value::Kind::integer);
    result.whole = value;
    return result;
}

Value real(double value) {
    Value result = node(Value::Kind::number);
    result.real = value;
    return result;
}

Value text(std::string value) {
    Value result = node(Value::Kind::text);
    result.text = std::move(value);
    return result;
}

Value list(std::vector<Value> items) {
    Value result = node(Value::Kind::list);
    result.items = std::move(items);
    return result;
}

Value list(const std::vector<std::string>& items) {
    return list_of(items, text);
}

Value list(const std::vector<double>& items) {
    return list_of(items, real);
}

Value map(std::vector<std::pair<std::string, Value>> entries) {
    Value result = node(Value::Kind::map);
    for (auto& [key, value] : entries) {
        append(result, std::move(key), std::move(value));
    }
    return result;
}

void append(Value& map, std::string key, Value value) {
    map.keys.push_back({std::move(key), {}});
    map.items.push_back(std::move(value));
}

std::string real_text(double value) {
    std::string text = number_text(value);
    const std::size_t exponent = text.find('e');
    if (text.find('.') == text.npos) {
        text.insert(std::min(exponent, text.size()), ".0");
    }
    return text;
}

std::string scalar_text(std::string_view text) {
    if (is_plain(text)) {
        return std::string(text);
    }
    std::string result = "\"";
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (c == '"' || c == '\\') {
            result += '\\';
            result += c;
        } else if (byte < 0x20 || byte == 0x7F) {
            result += fmt::format("\\x{:02x}", byte);
        } else {
            result += c;
        }
    }
    return result + "\"";
}

std::string flow_text(const Value& value) {
    switch (value.kind) {
    case Value::Kind::null:
        return "null";
    case Value::Kind::boolean:
        return value.flag ? "true" : "false";
    case Value::Kind::integer:
        return std::to_string(value.whole);
    case Value::Kind::number:
        return real_text(value.real);
    case Value::Kind::text:
        return scalar_text(value.text);
    case Value::Kind::list:
    case Value::Kind::map:
        break;
    }
    std::string text;
    for (std::size_t i = 0; i < value.items.size(); ++i) {
        text += i > 0 ? ", " : "";
        text += value.is(Value::Kind::map) ? scalar_text(value.keys[i].text) + ": " : "";
        text += flow_text(value.items[i]);
    }
    return value.is(Value::Kind::map) ? "{" + text + "}" : "[" + text + "]";
}

std::string json_text(const Value& value) {
    std::string text;
    add_json(text, value, 0);
    return text + "\n";
}

std::string block_text(const Value& value, std::size_t indent) {
    std::string text;
    add_block(text, value, indent);
    return text;
}

} // namespace foam::yaml
