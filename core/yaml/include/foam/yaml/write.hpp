// YAML and JSON to write: values, and parts of a text replaced by others.
#pragma once

#include <foam/base/error.hpp>
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

/// A YAML text that is edited.
class Splice {
public:
    /// Parses the text. `name`: of the file. Throws Error(code) with its place for a text that is no YAML map.
    Splice(std::string text, std::string name, ErrorCode code);

    const Value& root() const { return root_; }
    const std::string& text() const { return text_; }
    /// Returns the value at a path of keys; nullptr if there is none.
    const Value* find(const std::vector<std::string_view>& path) const;
    /// Replaces the value at a path of keys; adds the last key if only it is missing. A value on the line of its key,
    /// or within brackets, is replaced by one on one line. Comments within the replaced value go with it. Throws
    /// Error(code) with the place of what cannot be replaced.
    void set(const std::vector<std::string_view>& path, const Value& value);
    /// Appends items to the list at a path of keys, whose own bytes stay; adds the last key if only it is missing.
    /// Throws Error(code) with the place of what is no list.
    void extend(const std::vector<std::string_view>& path, const Value& items);

private:
    void parse();
    [[noreturn]] void fail(const Place& where, const std::string& what) const;
    std::size_t offset_of(const Place& place) const;
    std::size_t end_of_flow(std::size_t begin, const Place& where) const;
    std::size_t end_of_block(std::size_t line_after_key, std::size_t column, bool list) const;
    void replace(const Value& map, std::size_t index, const Value& value, bool in_flow);
    void add(const Value& map, std::string_view key, const Value& value);
    void append_in_flow(const Value& collection, const std::string& item);

    std::string text_, name_;
    ErrorCode code_;
    Value root_;
};

} // namespace yaml
} // namespace foam
