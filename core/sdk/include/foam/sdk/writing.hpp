// What writers ask of a model: pairs of links, what planners need, and what is not covered.
#pragma once

#include <foam/robot/robot.hpp>
#include <foam/sdk/model.hpp>
#include <foam/sdk/parameter.hpp>

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] sdk {

class Context;
struct SphereModel;
struct StageInfo;

/// What a writer does with the pairs in a file of the user (SphereModel::into).
enum class PairEdit {
    keep,    ///< they stay as they are
    merge,   ///< they stay, and those that foam finds beyond them are added
    replace, ///< those that foam finds take their place
};
/// The parameter "pairs" of writers for it.
Parameter pairs_parameter();
PairEdit pair_edit(const Parameters& parameters);

/// What a file of the user says of pairs.
struct StatedPairs {
    std::string file;
    std::vector<IgnoredPair> ignored{}; ///< they need no check
    /// Whether the file has a word of its own on a pair that is not in `ignored`, such as <enable_collisions>; this
    /// word stays.
    std::function<bool(const IgnoredPair&)> decided{};
};

/// Returns the pairs that a writer puts into the file: with merge beside those that are there, with replace in their
/// place; nothing: the file keeps its pairs. Logs how many are kept, added and removed, and the names of what is
/// removed. `found`: SphereModel::ignored_pairs.
std::optional<std::vector<IgnoredPair>> pairs_into(PairEdit edit, const StatedPairs& stated,
                                                   const std::optional<std::vector<IgnoredPair>>& found,
                                                   Context& context);

/// Warns where the pairs that need no check are not known; a model of one link has none.
void warn_without_pairs(const SphereModel& model, Context& context);

/// The joints of a robot that move and mimic no other, in the order of the URDF.
struct PlannedJoints {
    /// Joint and position, rad or m.
    using Positions = std::vector<std::pair<std::string, double>>;
    Positions active; ///< those that a planner moves, with their default position
    Positions locked; ///< those that it holds (RobotFacts::lock_joints)
};

/// Returns the joints. Throws Error(output) for a lock_joints or default_pose of a joint that does not move or that
/// mimics another. Precondition: the model has a robot.
PlannedJoints planned_joints(const SphereModel& model);

/// Returns the poses of the links at the robot's default pose, in the root link's frame; nothing for a model without
/// joints, whose links stand at the origin.
std::map<std::string, Pose> placed_links(const SphereModel& model);

/// Returns whether only the names of links are known: the robot has neither joints nor geometry.
bool has_only_names(const Robot& robot);
/// Throws Error(output) if the model has no robot but the names of links. `writer`: its name, for the message.
void require_robot(const SphereModel& model, const std::string& writer);
/// Returns RobotFacts::base_link, or the root link. Throws Error(output) for a link that the robot does not have.
const std::string& base_link(const SphereModel& model);
/// Gives the facts a tool frame where whole files of the writer name one and none is given: the tip of the robot, if it
/// has one tip alone; see tips_of(). `into`: the file of a user is edited, which has its own. Returns a sentence that
/// names it; empty if nothing was needed. Throws Error(usage), naming the tips and the remedy, if there are several.
std::string give_tool_frame(RobotFacts& facts, const Robot& robot, const StageInfo& writer, bool into);
/// Returns that sentence.
std::string sentence_about_tool_frame(const std::string& tip);
/// Returns RobotFacts::tool_frames. Throws Error(output) if there is none, or the robot does not have it.
const std::vector<std::string>& require_tool_frames(const SphereModel& model, const std::string& writer);

/// Returns the links with collision geometry that have no elements in the model, in the order of the robot's links: the
/// recipe skips them or leaves their geometry out, or they failed.
std::vector<std::string> uncovered_links(const SphereModel& model);

/// Collision geometry that stays, in files that are written whole.
struct KeptGeometry {
    std::string link;
    Elements primitives; ///< in the link's frame
    bool meshes = false; ///< the link has collision meshes, which do not stay
};
/// Returns the geometry of uncovered_links(), but for those that are to have none (SphereModel::without_collision).
std::vector<KeptGeometry> kept_geometry(const SphereModel& model);

/// Returns the path of a file as it is seen from a folder, which need not exist yet, with slashes. Symbolic links are
/// followed, but for the file itself: ".." leads where it says. From no folder: the whole path.
std::string path_seen_from(const std::filesystem::path& folder, const std::filesystem::path& file);

} // namespace sdk
} // namespace foam
