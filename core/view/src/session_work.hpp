// What a session is made of: robots that are loaded, the search, files that are saved, the history, requests.
#pragma once

#include <foam/recipe/recipe.hpp>
#include <foam/robot/robot.hpp>
#include <foam/view/session.hpp>
#include <foam/view/subject.hpp>

#include <atomic>
#include <cstddef>
#include <string>
#include <vector>

namespace foam::inline view {

/// Returns the index of a link. Precondition: the robot has it.
inline std::size_t link_index(const Robot& robot, const std::string& link) {
    return static_cast<std::size_t>(robot.find_link(link) - robot.links.data());
}

/// Returns "zero" (moved into the limits), "middle" of the limits, and the group states of an SRDF, which set the
/// joints that they name; in all of them `locks` stand where they are held. Throws Error(input) for an SRDF that cannot be read.
std::vector<NamedPose> named_poses(const Kinematics& kinematics, const std::filesystem::path& srdf,
                                   const JointValues& locks = {});

/// Reads a URDF, or a mesh as a robot of one link. Adds to `notes` what is left out.
ViewedRobot load_robot(const std::filesystem::path& file, const SubjectOptions& options, const Registry& registry,
                       std::vector<std::string>& notes);
/// Returns a robot of which only the names of links are known.
ViewedRobot robot_of_names(const SphereFile& file);
/// Returns whether a robot has spheres, and nothing else, as its collision geometry.
bool is_sphere_model(const Robot& robot);
bool is_sphere(const GeometryElement& element);
/// Returns whether the file is read as a mesh.
bool is_mesh_file(const std::filesystem::path& file, const Registry& registry);

/// Returns the spheres of a link that a search keeps.
std::vector<Sphere> pinned_in(const LinkState& link);

/// Returns `kept` and others, `count` in all or fewer, that are proved to cover the solid, also in single precision.
/// The search ends with its best spheres after `seconds`, or when `cancel` becomes true. Throws Error(usage) if the
/// kept ones leave geometry uncovered and are as many as `count`.
std::vector<Sphere> searched_link(const Solid& solid, std::size_t count, const std::vector<Sphere>& kept,
                                  double seconds, const std::atomic<bool>& cancel);

/// Returns the spheres grown until they are proved to cover the solid.
std::vector<Sphere> closed_link(const Solid& solid, const std::vector<Sphere>& spheres);

/// Returns the recipe that keeps spheres of links: the pinned ones, or all of them with `everything`.
Recipe recipe_of(const ViewedRobot& robot, const SubjectOptions& options, Registry& registry, const ModelState& state,
                 std::optional<std::size_t> count, bool everything);

/// Returns the formats of all writers, and "recipe".
std::vector<SaveFormat> save_formats(const Registry& registry);

/// Returns the file of that name in the folder. Throws Error(usage) for a name that leads elsewhere or is hidden.
std::filesystem::path target_of(const std::filesystem::path& folder, const std::string& name);

/// Throws Error(usage) if a file that the format writes is one of the inputs, or exists, unless `replace`, or if there
/// is no such format.
void require_free(const Registry& registry, const std::string& format, const std::filesystem::path& target,
                  const std::vector<std::filesystem::path>& inputs, bool replace);

/// Writes the model in the format of a writer. `original`: null if it is not known. Throws as Session::save().
Saved save_model(const ViewedRobot& robot, const Original* original, const Registry& registry, const ModelState& state,
                 const std::string& format, const std::filesystem::path& target, const std::atomic<bool>& cancel);

/// Writes a recipe that gives the model again. Throws as Session::save().
Saved save_recipe(const ViewedRobot& robot, const Original* original, const SubjectOptions& options, Registry& registry,
                  const ModelState& state, const std::filesystem::path& target);

class History {
public:
    explicit History(std::vector<ModelState> begin) : states_{std::move(begin)} {}

    const std::vector<ModelState>& now() const { return states_[at_]; }
    std::size_t version() const { return version_; }
    bool can_undo() const { return at_ > 0; }
    bool can_redo() const { return at_ + 1 < states_.size(); }
    /// Replaces a model; what was undone before is forgotten. Returns what changed.
    Change change(std::size_t model, ModelState state);
    /// Precondition: can_undo(), can_redo().
    Change undo();
    Change redo();

private:
    static constexpr std::size_t deepest = 1000; ///< states share the links that did not change

    /// Returns what changed from the state `from` to the present one. `model`: the answer if nothing did.
    Change difference(std::size_t from, std::size_t model) const;

    std::vector<std::vector<ModelState>> states_;
    std::size_t at_ = 0, version_ = 0;
};

/// The answers to the requests of a page; each is the text of a JSON object. They throw Error(usage) for a text that is
/// not the JSON of such a request, and as the session does.
std::string answer_edit(Session& session, const std::string& body);    ///< {"version", "kind", "model", …}
std::string answer_undo(Session& session, const std::string& body);    ///< {"version"}
std::string answer_redo(Session& session, const std::string& body);    ///< {"version"}
std::string answer_save(Session& session, const std::string& body);    ///< {"model", "format", "file", "replace"}
std::string answer_proofs(Session& session, const std::string& body);  ///< {"model"}: of all links
std::string answer_ignored(Session& session, const std::string& body); ///< {"model"}: pairs of links
std::string answer_figures(Session& session, const std::string& body); ///< {"model"}: protrusions of spheres

/// Returns the scene of the session as it is now.
std::string session_scene(Session& session);

} // namespace foam::inline view
