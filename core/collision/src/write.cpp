// The self-collision matrix in other tools' files.
#include <foam/base/text.hpp>
#include <foam/collision/self_collision.hpp>

#include <fmt/format.h>

namespace foam::inline collision {
namespace {

/// Returns a name within double quotes of YAML.
std::string yaml_quoted(const std::string& text) {
    std::string result = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') {
            result += '\\';
        }
        result += c;
    }
    return result + '"';
}

} // namespace

std::string sentence_about(const LinkPair& pair, const Robot& robot) {
    return fmt::format("its elements and those of {} touch in every pose that was tested, the geometry of the two links "
                       "in {} of {}: the pair is checked, and a planner refuses every pose; remedy: self_collision: true "
                       "in the recipe, which gives more elements of the budget to both links, or a larger budget",
                       shown(robot.links[pair.second].name), pair.geometry_touching, pair.geometry_samples);
}

std::vector<IgnoredPair> ignored_pairs(const Robot& robot, const SelfCollisionMatrix& matrix) {
    std::vector<IgnoredPair> ignored;
    for (const LinkPair& pair : matrix.pairs) {
        if (pair.reason != PairReason::none) {
            ignored.push_back({robot.links[pair.first].name, robot.links[pair.second].name, to_string(pair.reason)});
        }
    }
    return ignored;
}

std::string srdf_text(const Robot& robot, const SelfCollisionMatrix& matrix) {
    std::string text =
        fmt::format("<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<robot name=\"{}\">\n", attribute_escaped(robot.name));
    for (const LinkPair& pair : matrix.pairs) {
        if (pair.reason != PairReason::none) {
            text += fmt::format("  <disable_collisions link1=\"{}\" link2=\"{}\" reason=\"{}\"/>\n",
                                attribute_escaped(robot.links[pair.first].name),
                                attribute_escaped(robot.links[pair.second].name), to_string(pair.reason));
        }
    }
    return text + "</robot>\n";
}

std::string curobo_text(const Robot& robot, const SelfCollisionMatrix& matrix) {
    std::string text = "self_collision_ignore:\n";
    std::vector<std::vector<std::string>> ignored(robot.links.size());
    for (const LinkPair& pair : matrix.pairs) {
        if (pair.reason != PairReason::none) {
            ignored[pair.first].push_back(yaml_quoted(robot.links[pair.second].name));
        }
    }
    bool any = false;
    for (std::size_t i = 0; i < ignored.size(); ++i) {
        if (!ignored[i].empty()) {
            any = true;
            text += fmt::format("  {}: [{}]\n", yaml_quoted(robot.links[i].name), fmt::join(ignored[i], ", "));
        }
    }
    return any ? text : "self_collision_ignore: {}\n";
}

} // namespace foam::collision
