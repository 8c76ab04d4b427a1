// The keys of `robot` beside `urdf`: each is declared once. Reader, writer, schema and manifest come from this list.
#pragma once

#include <foam/recipe/recipe.hpp>
#include <foam/yaml/value.hpp>

#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] recipe {
namespace reading {

struct FactKey {
    std::string name, doc, unit;
    std::variant<std::string RobotFacts::*, std::vector<std::string> RobotFacts::*, JointValues RobotFacts::*,
                 std::optional<double> RobotFacts::*>
        member;
};

const std::vector<FactKey>& fact_keys();

/// Returns the facts that are given, as values.
yaml::Value given_facts(const RobotFacts& facts);

} // namespace reading
} // namespace recipe
} // namespace foam
