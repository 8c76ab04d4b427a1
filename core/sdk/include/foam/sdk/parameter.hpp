// Parameters of a stage, declared once: validation, help, schema, docs and cache key come from the declaration.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] sdk {

using ParameterValue = std::variant<bool, std::int64_t, double, std::string>;

/// One parameter, made by the named constructors and refined by the setters:
///     Parameter::number("ratio", 0.2).unit("1").bounds(0, 1).doc("Share of the triangles kept.").source("Coumar 2025")
struct Parameter {
    enum class Type { boolean, integer, number, text, choice };

    std::string name;
    Type type = Type::number;
    ParameterValue default_value = 0.0;
    std::string unit_text;            ///< "m", "1", "rad"; empty where there is none
    std::optional<double> low, high;  ///< inclusive bounds of integer and number
    std::vector<std::string> choices; ///< of choice
    std::string doc_text;             ///< one sentence
    std::string source_text;          ///< where the default comes from
    bool affects_output = true;       ///< false: not part of the cache key (thread counts and the like)

    static Parameter boolean(std::string name, bool default_value);
    static Parameter integer(std::string name, std::int64_t default_value);
    static Parameter number(std::string name, double default_value);
    static Parameter text(std::string name, std::string default_value);
    static Parameter choice(std::string name, std::vector<std::string> choices, std::string default_value);

    Parameter&& unit(std::string text) &&;
    Parameter&& bounds(double low, double high) &&;
    Parameter&& at_least(double low) &&;
    Parameter&& doc(std::string sentence) &&;
    Parameter&& source(std::string reference) &&;
    Parameter&& no_effect_on_output() &&;
};

const char* to_string(Parameter::Type type);
/// Returns the shortest text that reads back to the same value; locale-independent.
std::string to_text(const ParameterValue& value);
/// Returns what a value must be: "an integer between 1 and 8", "one of fast, exact".
std::string expectation(const Parameter& parameter);
/// Returns why `value` is not allowed for `parameter` ("expects an integer between 1 and 8, got 9"); empty if it is
/// allowed. An integer is accepted for a number.
std::string why_invalid(const Parameter& parameter, const ParameterValue& value);

/// Checked values of all parameters of a stage, with the defaults filled in.
class Parameters {
public:
    Parameters();
    /// Throws Error(usage) for an unknown name or a value out of bounds.
    Parameters(const std::vector<Parameter>& declared, const std::map<std::string, ParameterValue>& given);
    ~Parameters();
    Parameters(const Parameters&);
    Parameters(Parameters&&) noexcept;
    Parameters& operator=(const Parameters&);
    Parameters& operator=(Parameters&&) noexcept;

    /// Throw Error(internal) for a name that was not declared with that type.
    bool boolean(std::string_view name) const;
    std::int64_t integer(std::string_view name) const;
    double number(std::string_view name) const;
    const std::string& text(std::string_view name) const; ///< text and choice
    const std::map<std::string, ParameterValue, std::less<>>& values() const { return values_; }

private:
    const ParameterValue& at(std::string_view name) const;
    std::map<std::string, ParameterValue, std::less<>> values_;
};

} // namespace sdk
} // namespace foam
