// As much of JSON as written models take.
#pragma once

#include "vector.hpp"

#include <map>
#include <string>
#include <vector>

namespace judge {

/// One value. What does not belong to its type is empty.
struct Json {
    double number = 0; ///< to the nearest double
    std::string text;
    std::vector<Json> items;
    std::map<std::string, Json> members;

    /// Throws std::runtime_error if there is none.
    const Json& at(const std::string& name) const;
    /// The list of that name; empty if there is none.
    const std::vector<Json>& list(const std::string& name) const;
    /// Three numbers. Throws std::runtime_error.
    Point point() const;
};

/// Throws std::runtime_error.
Json parse_json(const std::string& text);

} // namespace judge
