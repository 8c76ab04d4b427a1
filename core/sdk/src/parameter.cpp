#include <foam/base/error.hpp>
#include <foam/base/text.hpp>
#include <foam/sdk/parameter.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace foam::inline sdk {
namespace {

Parameter make(std::string name, Parameter::Type type, ParameterValue default_value) {
    Parameter parameter;
    parameter.name = std::move(name);
    parameter.type = type;
    parameter.default_value = std::move(default_value);
    return parameter;
}

const char* kind_of(const ParameterValue& value) {
    static constexpr const char* names[] = {"true/false", "integer", "number", "text"};
    return names[value.index()];
}

} // namespace

Parameter Parameter::boolean(std::string name, bool default_value) {
    return make(std::move(name), Type::boolean, default_value);
}
Parameter Parameter::integer(std::string name, std::int64_t default_value) {
    return make(std::move(name), Type::integer, default_value);
}
Parameter Parameter::number(std::string name, double default_value) {
    return make(std::move(name), Type::number, default_value);
}
Parameter Parameter::text(std::string name, std::string default_value) {
    return make(std::move(name), Type::text, std::move(default_value));
}
Parameter Parameter::choice(std::string name, std::vector<std::string> choices, std::string default_value) {
    Parameter parameter = make(std::move(name), Type::choice, std::move(default_value));
    parameter.choices = std::move(choices);
    return parameter;
}

Parameter&& Parameter::unit(std::string text) && {
    unit_text = std::move(text);
    return std::move(*this);
}
Parameter&& Parameter::bounds(double lowest, double highest) && {
    low = lowest;
    high = highest;
    return std::move(*this);
}
Parameter&& Parameter::at_least(double lowest) && {
    low = lowest;
    return std::move(*this);
}
Parameter&& Parameter::doc(std::string sentence) && {
    doc_text = std::move(sentence);
    return std::move(*this);
}
Parameter&& Parameter::source(std::string reference) && {
    source_text = std::move(reference);
    return std::move(*this);
}
Parameter&& Parameter::no_effect_on_output() && {
    affects_output = false;
    return std::move(*this);
}

const char* to_string(Parameter::Type type) {
    switch (type) {
    case Parameter::Type::boolean:
        return "boolean";
    case Parameter::Type::integer:
        return "integer";
    case Parameter::Type::number:
        return "number";
    case Parameter::Type::text:
        return "text";
    case Parameter::Type::choice:
        return "choice";
    }
    return "";
}

std::string to_text(const ParameterValue& value) {
    if (const bool* b = std::get_if<bool>(&value)) {
        return *b ? "true" : "false";
    }
    if (const std::int64_t* i = std::get_if<std::int64_t>(&value)) {
        return fmt::format("{}", *i);
    }
    if (const double* d = std::get_if<double>(&value)) {
        return number_text(*d);
    }
    return std::get<std::string>(value);
}

std::string expectation(const Parameter& p) {
    switch (p.type) {
    case Parameter::Type::boolean:
        return "true or false";
    case Parameter::Type::text:
        return "text";
    case Parameter::Type::choice:
        return fmt::format("one of {}", fmt::join(p.choices, ", "));
    case Parameter::Type::integer:
    case Parameter::Type::number:
        break;
    }
    const auto bound = [](double value) {
        const bool whole = std::abs(value) < 1e15 && std::floor(value) == value;
        return whole ? fmt::format("{}", static_cast<std::int64_t>(value)) : number_text(value);
    };
    std::string text = p.type == Parameter::Type::integer ? "an integer" : "a number";
    if (p.low && p.high) {
        text += fmt::format(" between {} and {}", bound(*p.low), bound(*p.high));
    } else if (p.low) {
        text += fmt::format(" of at least {}", bound(*p.low));
    } else if (p.high) {
        text += fmt::format(" of at most {}", bound(*p.high));
    }
    return text;
}

std::string why_invalid(const Parameter& p, const ParameterValue& value) {
    const std::string* text = std::get_if<std::string>(&value);
    const auto in_bounds = [&](double number) {
        return number >= p.low.value_or(number) && number <= p.high.value_or(number); // false for NaN
    };
    bool valid = false;
    switch (p.type) {
    case Parameter::Type::boolean:
        valid = std::holds_alternative<bool>(value);
        break;
    case Parameter::Type::text:
        valid = text != nullptr;
        break;
    case Parameter::Type::choice:
        valid = text && std::find(p.choices.begin(), p.choices.end(), *text) != p.choices.end();
        break;
    case Parameter::Type::integer:
    case Parameter::Type::number:
        if (const std::int64_t* whole = std::get_if<std::int64_t>(&value)) {
            valid = in_bounds(static_cast<double>(*whole));
        } else if (const double* real = std::get_if<double>(&value); real && p.type == Parameter::Type::number) {
            valid = in_bounds(*real);
        }
        break;
    }
    if (valid) {
        return "";
    }
    const char* quote = text ? "\"" : "";
    return fmt::format("expects {}, got {}{}{}", expectation(p), quote, to_text(value), quote);
}

Parameters::Parameters() = default;
Parameters::~Parameters() = default;
Parameters::Parameters(const Parameters&) = default;
Parameters::Parameters(Parameters&&) noexcept = default;
Parameters& Parameters::operator=(const Parameters&) = default;
Parameters& Parameters::operator=(Parameters&&) noexcept = default;

Parameters::Parameters(const std::vector<Parameter>& declared, const std::map<std::string, ParameterValue>& given) {
    for (const Parameter& p : declared) {
        values_[p.name] = p.default_value;
    }
    for (const auto& [name, value] : given) {
        const auto it = std::find_if(declared.begin(), declared.end(),
                                     [&, &name = name](const Parameter& p) { return p.name == name; });
        if (it == declared.end()) {
            throw Error(ErrorCode::usage, fmt::format("unknown parameter '{}'", name));
        }
        if (const std::string why = why_invalid(*it, value); !why.empty()) {
            throw Error(ErrorCode::usage, fmt::format("parameter '{}' {}", name, why));
        }
        const std::int64_t* whole = std::get_if<std::int64_t>(&value);
        values_[name] =
            it->type == Parameter::Type::number && whole ? ParameterValue(static_cast<double>(*whole)) : value;
    }
}

const ParameterValue& Parameters::at(std::string_view name) const {
    const auto it = values_.find(name);
    if (it == values_.end()) {
        throw Error(ErrorCode::internal,
                    fmt::format("the stage asks for parameter '{}', which it did not declare", name));
    }
    return it->second;
}

namespace {
template <class T> const T& as(const ParameterValue& value, std::string_view name, const char* wanted) {
    if (const T* result = std::get_if<T>(&value)) {
        return *result;
    }
    throw Error(ErrorCode::internal, fmt::format("the stage asks for parameter '{}' as {}, but declared it as {}", name,
                                                 wanted, kind_of(value)));
}
} // namespace

bool Parameters::boolean(std::string_view name) const {
    return as<bool>(at(name), name, "true/false");
}
std::int64_t Parameters::integer(std::string_view name) const {
    return as<std::int64_t>(at(name), name, "integer");
}
double Parameters::number(std::string_view name) const {
    return as<double>(at(name), name, "number");
}
const std::string& Parameters::text(std::string_view name) const {
    return as<std::string>(at(name), name, "text");
}

} // namespace foam::sdk
