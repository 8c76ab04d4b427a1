#include <foam/base/error.hpp>
#include <foam/base/internal/files.hpp>
#include <foam/base/text.hpp>
#include <foam/judge/collision_model.hpp>
#include <foam/yaml/value.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace foam::inline judge {
namespace {

using yaml::Value;

/// A list of poses in a file.
class PoseFile {
public:
    explicit PoseFile(const std::filesystem::path& file) : file_(file) {}

    std::vector<JointValues> poses() const {
        constexpr yaml::TextKind kind{.name = "file of poses", .most_bytes = most_robot_bytes};
        const Value root = yaml::tree_of(read_file(file_, most_robot_bytes), file_.string(), kind);
        require(root.is(Value::Kind::list) && !root.items.empty(), root,
                "a list of poses, such as [{elbow: 1.2, wrist: 0}]");
        std::vector<JointValues> poses;
        for (const Value& item : root.items) {
            poses.push_back(pose_of(item));
        }
        return poses;
    }

private:
    JointValues pose_of(const Value& item) const {
        require(item.is(Value::Kind::map), item, "a map from joints to positions");
        JointValues pose;
        for (std::size_t i = 0; i < item.keys.size(); ++i) {
            const Value& value = item.items[i];
            require(value.is(Value::Kind::integer) || value.is(Value::Kind::number), value, "a number of rad or m");
            pose.emplace(item.keys[i].text,
                         value.is(Value::Kind::integer) ? static_cast<double>(value.whole) : value.real);
        }
        return pose;
    }
    void require(bool fine, const Value& value, const char* expected) const {
        if (!fine) {
            throw Error(ErrorCode::input, fmt::format("{}:{}:{}: expected {}, got {}", file_.string(), value.where.line,
                                                      value.where.column, expected, value.description()));
        }
    }

    const std::filesystem::path& file_;
};

LinkSolids solids_of(const Original& original) {
    LinkSolids solids(original.robot->links.size());
    for (const OriginalLink& link : original.links) {
        solids[static_cast<std::size_t>(original.robot->find_link(link.link) - original.robot->links.data())] =
            link.solid;
    }
    return solids;
}

/// Returns the pairs of links with geometry that a file does not exclude.
LinkPairs pairs_beside(const std::filesystem::path& ignored, const Robot& robot, const LinkSolids& solids) {
    std::set<std::pair<std::string, std::string>> excluded;
    for (const IgnoredPair& pair : read_ignored_pairs(ignored)) {
        excluded.insert(std::minmax(pair.first, pair.second));
    }
    LinkPairs pairs;
    for (std::size_t a = 0; a < solids.size(); ++a) {
        for (std::size_t b = a + 1; b < solids.size(); ++b) {
            if (solids[a] && solids[b] && !excluded.contains(std::minmax(robot.links[a].name, robot.links[b].name))) {
                pairs.emplace_back(a, b);
            }
        }
    }
    return pairs;
}

} // namespace

std::vector<std::vector<double>> read_poses(const std::filesystem::path& file, const Kinematics& kinematics) {
    std::vector<std::vector<double>> configurations;
    for (const JointValues& pose : PoseFile(file).poses()) {
        try {
            configurations.push_back(kinematics.configuration(pose));
        } catch (const Error& error) {
            throw Error(ErrorCode::input,
                        fmt::format("{}: pose {}: {}", file.string(), configurations.size() + 1, error.what()));
        }
    }
    return configurations;
}

Consequences judged_in_poses(const Original& original, const MatchedModel& model, const PoseOptions& options) {
    const Kinematics kinematics(original.robot);
    const CollisionModel collision = collision_model_of(original, model);
    const LinkSolids solids = solids_of(original);
    std::optional<LinkPairs> pairs;
    if (!options.ignored.empty()) {
        pairs = pairs_beside(options.ignored, *original.robot, solids);
    }
    std::vector<std::vector<double>> configurations;
    if (!options.file.empty()) {
        configurations = read_poses(options.file, kinematics);
    }
    for (std::vector<double>& random : random_configurations(kinematics, options.random, options.seed)) {
        configurations.push_back(std::move(random));
    }
    Consequences found = consequences_of(kinematics, collision, solids, pairs, configurations);
    if (found.pairs.empty()) {
        throw Error(
            ErrorCode::input,
            fmt::format("{}: no pair of links is left to check in poses: links with geometry are neighbours, or "
                        "excluded",
                        original.file.string()));
    }
    return found;
}

} // namespace foam::judge
