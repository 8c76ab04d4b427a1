#include <foam/recipe/internal/yaml.hpp>

#include "format.hpp"

#include <foam/base/text.hpp>
#include <foam/geometry/length.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace foam::inline recipe::reading {
namespace {

bool is_numeric(const Parameter& p) {
    return p.type == Parameter::Type::integer || p.type == Parameter::Type::number;
}

bool is_numeric(const Value& value) {
    return value.is(Value::Kind::integer) || value.is(Value::Kind::number);
}

/// Returns a proposal for a text that was meant as a number: without quotes, group separators or unit, with a decimal
/// point.
std::string number_remedy(const Value& value, const Parameter& p) {
    std::string bare = value.text;
    if (is_numeric(plain_scalar(bare, value.where))) {
        return fmt::format("; remedy: without quotes, {}", bare);
    }
    bare.erase(std::remove(bare.begin(), bare.end(), '_'), bare.end());
    if (std::count(bare.begin(), bare.end(), ',') == 1) {
        std::replace(bare.begin(), bare.end(), ',', '.');
    }
    if (is_numeric(plain_scalar(bare, value.where))) {
        return fmt::format("; remedy: write {}", bare);
    }
    if (is_length(p)) { // outside its bounds, or not a length
        return parse_length(value.text) ? "" : fmt::format("; remedy: write {}", length_forms());
    }
    const std::size_t end = bare.find_first_not_of("0123456789.+-");
    if (end != 0 && end != std::string::npos && is_numeric(plain_scalar(bare.substr(0, end), value.where))) {
        return p.unit_text.empty() || p.unit_text == "1"
                   ? "; remedy: write the bare number"
                   : fmt::format("; remedy: write the bare number, in {}", p.unit_text);
    }
    return "";
}

std::string boolean_remedy(const Value& value) {
    static constexpr std::string_view yes[] = {"yes", "Yes", "YES", "on",   "On",   "ON",
                                               "y",   "Y",   "1",   "true", "True", "TRUE"};
    static constexpr std::string_view no[] = {"no", "No", "NO", "off",   "Off",   "OFF",
                                              "n",  "N",  "0",  "false", "False", "FALSE"};
    if (std::find(std::begin(yes), std::end(yes), value.text) != std::end(yes)) {
        return "; remedy: write true";
    }
    return std::find(std::begin(no), std::end(no), value.text) != std::end(no) ? "; remedy: write false" : "";
}

std::string remedy(const Value& value, const Parameter& p) {
    switch (p.type) {
    case Parameter::Type::boolean:
        return value.is_scalar() ? boolean_remedy(value) : "";
    case Parameter::Type::integer:
    case Parameter::Type::number:
        if (value.is(Value::Kind::number) && std::isnan(value.real)) {
            return "; remedy: write a finite number that a double can hold";
        }
        if (value.is(Value::Kind::number) && p.type == Parameter::Type::integer && std::abs(value.real) > 9e15) {
            return "; remedy: write a number of at most 64 bits";
        }
        return value.is(Value::Kind::text) ? number_remedy(value, p) : "";
    case Parameter::Type::text:
        return value.is_scalar() && !value.is(Value::Kind::null)
                   ? fmt::format("; remedy: put it in quotes, \"{}\"", value.text)
                   : "";
    case Parameter::Type::choice: {
        const std::string near = value.is(Value::Kind::text) ? nearest_word(value.text.substr(0, 100), p.choices) : "";
        return near.empty() ? "" : fmt::format("; did you mean {}?", in_quotes(near));
    }
    }
    return "";
}

/// Returns the value in the declared type; nothing if it has another type.
std::optional<ParameterValue> convert(const Value& value, const Parameter& p) {
    constexpr double exact = 9007199254740992.0; // 2^53: above, a double no longer holds every integer
    switch (p.type) {
    case Parameter::Type::boolean:
        return value.is(Value::Kind::boolean) ? std::optional<ParameterValue>(value.flag) : std::nullopt;
    case Parameter::Type::text:
    case Parameter::Type::choice:
        return value.is(Value::Kind::text) ? std::optional<ParameterValue>(value.text) : std::nullopt;
    case Parameter::Type::number:
        if (value.is(Value::Kind::integer)) {
            return static_cast<double>(value.whole);
        }
        if (value.is(Value::Kind::text) && is_length(p) && !parse_number(value.text)) {
            const std::optional<double> metres = parse_length(value.text);
            return metres ? std::optional<ParameterValue>(*metres) : std::nullopt;
        }
        return value.is(Value::Kind::number) && std::isfinite(value.real) ? std::optional<ParameterValue>(value.real)
                                                                          : std::nullopt;
    case Parameter::Type::integer:
        if (value.is(Value::Kind::integer)) {
            return value.whole;
        }
        if (value.is(Value::Kind::number) && std::abs(value.real) <= exact && std::floor(value.real) == value.real) {
            return static_cast<std::int64_t>(value.real);
        }
        return std::nullopt;
    }
    return std::nullopt;
}

} // namespace

std::optional<ParameterValue> read_value(const Value& value, const Parameter& p, std::string_view owner,
                                         Findings& findings) {
    const std::string name = owner.empty() ? in_quotes(p.name) : fmt::format("{} of {}", in_quotes(p.name), owner);
    std::optional<ParameterValue> result = convert(value, p);
    if (result && why_invalid(p, *result).empty()) {
        return result;
    }
    const bool too_large = is_numeric(p) && value.is(Value::Kind::number) && std::floor(value.real) == value.real;
    const char* code = !result && !too_large ? "wrong-type" : is_numeric(p) ? "out-of-bounds" : "unknown-choice";
    findings.error(value.where, code,
                   fmt::format("{} expects {}, got {}{}", name, expectation(p), value.description(), remedy(value, p)));
    return std::nullopt;
}

std::map<std::string, ParameterValue> read_values(const Value& map, const std::vector<Parameter>& declared,
                                                  std::string_view owner, const std::vector<std::string>& other_keys,
                                                  Findings& findings) {
    std::vector<std::string> known;
    std::map<std::string, ParameterValue> result;
    for (const Parameter& p : declared) {
        known.push_back(p.name);
        if (const Value* value = map.find(p.name)) {
            if (auto checked = read_value(*value, p, owner, findings)) {
                result.emplace(p.name, std::move(*checked));
            }
        }
    }
    known.insert(known.end(), other_keys.begin(), other_keys.end());
    refuse_unknown_keys(map, owner, known, findings);
    return result;
}

void refuse_unknown_keys(const Value& map, std::string_view owner, const std::vector<std::string>& known,
                         Findings& findings) {
    for (const Key& key : map.keys) {
        if (std::find(known.begin(), known.end(), key.text) != known.end()) {
            continue;
        }
        const std::size_t colon = key.text.find(':');
        if (std::find(known.begin(), known.end(), key.text.substr(0, colon)) != known.end()) {
            findings.error(key.where, "unknown-key",
                           fmt::format("unknown key {}; remedy: put a space after the ':'", in_quotes(key.text)));
        } else {
            findings.error(key.where, "unknown-key",
                           fmt::format("unknown key {}{}{}{}", in_quotes(key.text), owner.empty() ? "" : " in ", owner,
                                       suggestion(key.text, known)));
        }
    }
}

bool expect_map(const Value& value, std::string_view name, std::string_view example, Findings& findings) {
    if (value.is(Value::Kind::map)) {
        return true;
    }
    findings.error(value.where, "wrong-type",
                   fmt::format("'{}' expects a map, got {}; remedy: write {}", name, value.description(), example));
    return false;
}

bool expect_list(const Value& value, std::string_view name, std::string_view example, Findings& findings) {
    if (value.is(Value::Kind::list)) {
        return true;
    }
    findings.error(value.where, "wrong-type",
                   fmt::format("'{}' expects a list, got {}; remedy: write {}", name, value.description(), example));
    return false;
}

std::vector<std::string> read_texts(const Value& value, std::string_view name, Findings& findings) {
    const std::vector<Value> one = {value};
    const std::vector<Value>& items = value.is(Value::Kind::list) ? value.items : one;
    std::vector<std::string> texts;
    for (const Value& item : items) {
        if (item.is(Value::Kind::text) && !item.text.empty()) {
            texts.push_back(item.text);
            continue;
        }
        const bool scalar = item.is_scalar() && !item.text.empty() && !item.is(Value::Kind::text);
        findings.error(item.where, "wrong-type",
                       fmt::format("'{}' expects a text or a list of texts, got {}{}", name, item.description(),
                                   scalar ? fmt::format("; remedy: put it in quotes, \"{}\"", item.text) : ""));
    }
    if (items.empty()) {
        findings.error(value.where, "wrong-type",
                       fmt::format("'{}' expects at least one text, got an empty list", name));
    }
    return texts;
}

} // namespace foam::recipe::reading
