// YAML text that every reader takes alike: YAML 1.1 (PyYAML) and 1.2.
#pragma once

#include <foam/yaml/value.hpp>

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace foam {
namespace [[gnu::visibility("default")]] yaml {

/// Return nodes without a place.
Value null();
Value boolean(bool value);
Value integer(std::int64_t value);
/// Precondition: the number is finite.
Value real(double value);
Value text(std::string value);
Value list(std::vector<Value> items = {});
Value list(const std::vector<std::string>& items);
Value list(const std::vector<double>& items);
Value map(std::vector<std::pair<std::string, Value>> entries = {});

/// Appends a key to a map.
void append(Value& map, std::string key, Value value);

/// Returns a number that readers take for a float, and read to the same double: with a point, and a sign before the
/// exponent. PyYAML takes "1e-05" for a text.
std::string real_text(double value);
/// Returns a text as a scalar: plain if no reader takes it for anything else, otherwise within double quotes.
std::string scalar_text(std::string_view text);

/// Returns the node on one line: {key: [1.0, 2.0]}.
std::string flow_text(const Value& value);
/// Returns the node as lines, each indented by `indent` blanks and with a line end. Lists and maps that hold lists of
/// scalars at most are on one line each.
std::string block_text(const Value& value, std::size_t indent = 0);

/// Returns the node as JSON with a line end, in lines as block_text().
std::string json_text(const Value& value);

} // namespace yaml
} // namespace foam
