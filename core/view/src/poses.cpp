#include "poses.hpp"

#include <foam/base/internal/files.hpp>
#include <foam/robot/robot.hpp>

namespace foam::inline view {
std::vector<NamedPose> named_poses(const Kinematics& kinematics, const std::filesystem::path& srdf) {
    std::vector<NamedPose> poses{{"zero", kinematics.configuration()}, {"middle", {}}};
    for (const Freedom& freedom : kinematics.freedoms()) {
        poses.back().configuration.push_back((freedom.lower + freedom.upper) / 2);
    }
    if (srdf.empty()) {
        return poses;
    }
    for (const GroupState& state : group_states(read_file(srdf, most_robot_bytes), srdf.string())) {
        NamedPose& pose = poses.emplace_back(NamedPose{state.name, kinematics.configuration()});
        for (std::size_t i = 0; i < pose.configuration.size(); ++i) { // joints of another version are left out
            if (const auto value = state.values.find(kinematics.freedoms()[i].joint); value != state.values.end()) {
                pose.configuration[i] = value->second;
            }
        }
    }
    return poses;
}

} // namespace foam::inline view
