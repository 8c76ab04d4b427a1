#include "format.hpp"

#include <foam/recipe/internal/check.hpp>
#include <foam/recipe/internal/keys.hpp>
#include <foam/yaml/write.hpp>

#include <fmt/format.h>

namespace foam::inline recipe::reading {
namespace {

yaml::Value value_of_fact(const std::string& fact) {
    return yaml::text(fact);
}
yaml::Value value_of_fact(const std::vector<std::string>& fact) {
    return yaml::list(fact);
}
yaml::Value value_of_fact(const std::optional<double>& fact) {
    return yaml::real(fact.value_or(0));
}
yaml::Value value_of_fact(const JointValues& fact) {
    yaml::Value map = yaml::map();
    for (const auto& [joint, position] : fact) {
        yaml::append(map, joint, yaml::real(position));
    }
    return map;
}

void read_fact(const Value& value, const FactKey& key, std::string& fact, Findings& findings) {
    if (const auto read = read_value(value, Parameter::text(key.name, ""), "robot", findings)) {
        fact = std::get<std::string>(*read);
    }
}
void read_fact(const Value& value, const FactKey& key, std::optional<double>& fact, Findings& findings) {
    const Parameter limit = Parameter::number(key.name, 1).bounds(1e-6, 1e9).unit(key.unit);
    if (const auto read = read_value(value, limit, "robot", findings)) {
        fact = std::get<double>(*read);
    }
}
void read_fact(const Value& value, const FactKey& key, std::vector<std::string>& fact, Findings& findings) {
    if (!expect_list(value, key.name, fmt::format("{}: [NAME]", key.name), findings)) {
        return;
    }
    for (const Value& item : value.items) {
        if (const auto read = read_value(item, Parameter::text(key.name, ""), "robot", findings)) {
            fact.push_back(std::get<std::string>(*read));
        }
    }
}
void read_fact(const Value& value, const FactKey& key, JointValues& fact, Findings& findings) {
    fact = read_pose(value, findings, key.name);
}

} // namespace

const std::vector<FactKey>& fact_keys() {
    static const std::vector<FactKey> keys{
        {"base_link", "The link that the robot stands on; absent: the root of the URDF.", "", &RobotFacts::base_link},
        {"tool_frames",
         "The links that a planner moves to a goal; absent: the tip of a robot with one, where a format needs it.", "",
         &RobotFacts::tool_frames},
        {"lock_joints", "Joints that a planner holds, and their positions, rad or m: the fingers of a gripper.", "",
         &RobotFacts::lock_joints},
        {"default_pose", "The rest position of joints, rad or m; joints not named: zero, moved into the limits.", "",
         &RobotFacts::default_pose},
        {"acceleration", "Largest acceleration of every joint.", "rad/s2 or m/s2", &RobotFacts::acceleration},
        {"jerk", "Largest jerk of every joint.", "rad/s3 or m/s3", &RobotFacts::jerk},
    };
    return keys;
}

yaml::Value given_facts(const RobotFacts& facts) {
    yaml::Value given = yaml::map();
    const RobotFacts none;
    for (const FactKey& key : fact_keys()) {
        std::visit(
            [&](auto member) {
                if (facts.*member != none.*member) {
                    yaml::append(given, key.name, value_of_fact(facts.*member));
                }
            },
            key.member);
    }
    return given;
}

void check_facts(const Value& robot, Recipe& recipe, Findings& findings) {
    for (const FactKey& key : fact_keys()) {
        if (const Value* value = robot.find(key.name)) {
            std::visit([&](auto member) { read_fact(*value, key, recipe.facts.*member, findings); }, key.member);
        }
    }
    recipe.facts_where = findings.locate(robot.where);
}

nlohmann::ordered_json schema_of_facts() {
    using Json = nlohmann::ordered_json;
    Json properties;
    for (const FactKey& key : fact_keys()) {
        Json schema{{"description", key.doc + (key.unit.empty() ? "" : " Unit: " + key.unit + ".")}};
        switch (key.member.index()) {
        case 0:
            schema["type"] = "string";
            break;
        case 1:
            schema["type"] = "array";
            schema["items"] = {{"type", "string"}};
            break;
        case 2:
            schema["type"] = "object";
            schema["additionalProperties"] = {{"type", "number"}};
            break;
        default:
            schema["type"] = "number";
            schema["minimum"] = 1e-6;
            schema["maximum"] = 1e9;
        }
        properties[key.name] = std::move(schema);
    }
    return properties;
}

} // namespace foam::inline recipe::reading
