// A robot of links in a row.
#pragma once

#include <foam/robot/kinematics.hpp>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace foam::test {

/// Links in a row, each moved by one joint against the one before. Before the first there is a link with the same frame,
/// and one behind the last.
struct Arm {
    struct Mover {
        Joint::Kind kind;
        Vec3 at, axis;
        double lower, upper;
    };
    std::vector<Mover> movers;
    std::optional<double> multiplier{}; ///< of the last joint, which follows the first one

    std::shared_ptr<const Robot> robot() const {
        Robot robot;
        robot.name = "made";
        robot.root = "first";
        robot.links.push_back({.name = "first", .collisions = {}, .visuals = {}});
        const auto add = [&](const std::string& name, const std::string& joint, const Mover& mover) {
            robot.joints.push_back({.name = joint,
                                    .kind = mover.kind,
                                    .parent = robot.links.back().name,
                                    .child = name,
                                    .origin = Pose::from_xyz_rpy(mover.at, {}),
                                    .axis = normalized(mover.axis),
                                    .lower = mover.lower,
                                    .upper = mover.upper});
            robot.links.push_back({.name = name, .collisions = {}, .visuals = {}});
        };
        const Mover rigid{Joint::Kind::fixed, {}, {0, 0, 1}, 0, 0};
        add("l0", "to_l0", rigid);
        for (std::size_t i = 0; i < movers.size(); ++i) {
            const std::string number = std::to_string(i + 1);
            add("l" + number, "j" + number, movers[i]);
        }
        if (multiplier) {
            robot.joints.back().mimic = Mimic{.joint = "j1", .multiplier = *multiplier};
        }
        add("last", "to_last", rigid);
        return std::make_shared<const Robot>(robot);
    }
};

} // namespace foam::test
