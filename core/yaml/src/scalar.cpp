// Plain scalars that are null, true/false or numbers: YAML 1.2.2, section 10.3.2 (core schema).
#include <foam/yaml/value.hpp>

#include <algorithm>
#include <charconv>
#include <limits>

namespace foam::yaml {
namespace {

bool one_of(std::string_view text, std::initializer_list<std::string_view> words) {
    return std::find(words.begin(), words.end(), text) != words.end();
}

std::size_t digits_from(std::string_view text, std::size_t at) {
    std::size_t end = at;
    while (end < text.size() && text[end] >= '0' && text[end] <= '9') {
        ++end;
    }
    return end - at;
}

/// Returns whether the text matches [-+]? ( \. [0-9]+ | [0-9]+ ( \. [0-9]* )? ) ( [eE] [-+]? [0-9]+ )?
bool is_decimal_number(std::string_view text) {
    std::size_t at = !text.empty() && (text[0] == '-' || text[0] == '+') ? 1 : 0;
    const std::size_t before = digits_from(text, at);
    at += before;
    if (at < text.size() && text[at] == '.') {
        const std::size_t after = digits_from(text, at + 1);
        if (before + after == 0) {
            return false;
        }
        at += 1 + after;
    } else if (before == 0) {
        return false;
    }
    if (at < text.size() && (text[at] == 'e' || text[at] == 'E')) {
        ++at;
        at += at < text.size() && (text[at] == '-' || text[at] == '+') ? 1 : 0;
        const std::size_t exponent = digits_from(text, at);
        if (exponent == 0) {
            return false;
        }
        at += exponent;
    }
    return at == text.size();
}

/// Reads all of `digits`. Returns false for another character or an overflow.
bool read_whole(std::string_view digits, int base, std::int64_t& value) {
    const char* end = digits.data() + digits.size();
    const auto [stop, error] = std::from_chars(digits.data(), end, value, base);
    return !digits.empty() && error == std::errc() && stop == end;
}

void set_decimal(Value& value) {
    std::string_view digits = value.text;
    digits.remove_prefix(digits.starts_with('+') ? 1 : 0);
    if (digits.find_first_of(".eE") == std::string_view::npos && read_whole(digits, 10, value.whole)) {
        value.kind = Value::Kind::integer;
        return;
    }
    value.kind = Value::Kind::number;
    const auto [stop, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value.real);
    if (error != std::errc()) {
        value.real = std::numeric_limits<double>::quiet_NaN(); // exceeds a double; the check of the value reports it
    }
}

} // namespace

Value plain_scalar(std::string text, const Place& where) {
    Value value;
    value.where = where;
    value.text = std::move(text);
    const std::string_view t = value.text;
    if (one_of(t, {"", "~", "null", "Null", "NULL"})) {
        value.kind = Value::Kind::null;
    } else if (one_of(t, {"true", "True", "TRUE"}) || one_of(t, {"false", "False", "FALSE"})) {
        value.kind = Value::Kind::boolean;
        value.flag = t[0] == 't' || t[0] == 'T';
    } else if (t.size() > 2 && t.starts_with("0x") && t[2] != '-' && read_whole(t.substr(2), 16, value.whole)) {
        value.kind = Value::Kind::integer;
    } else if (t.size() > 2 && t.starts_with("0o") && t[2] != '-' && read_whole(t.substr(2), 8, value.whole)) {
        value.kind = Value::Kind::integer;
    } else if (is_decimal_number(t)) {
        set_decimal(value);
    } else if (one_of(t, {".inf", ".Inf", ".INF", "+.inf", "+.Inf", "+.INF", "-.inf", "-.Inf", "-.INF", ".nan", ".NaN",
                          ".NAN"})) {
        value.kind = Value::Kind::number;
        value.real = std::numeric_limits<double>::quiet_NaN(); // no value of a recipe may be infinite or undefined
    } else {
        value.kind = Value::Kind::text;
    }
    return value;
}

} // namespace foam::yaml
