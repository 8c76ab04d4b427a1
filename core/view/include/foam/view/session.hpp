// A session of `foam view`: sphere models that are edited, searched again, proved and saved.
#pragma once

#include <foam/geometry/measure.hpp>
#include <foam/view/scene.hpp>
#include <foam/view/subject.hpp>

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] view {

/// The spheres of a link in a session.
struct LinkState {
    std::vector<Sphere> spheres;
    std::vector<bool> pinned; ///< of each sphere: a search keeps it as it is
    double weight = 1;        ///< factor of the link's excess volume when spheres are allocated over the robot

    bool operator==(const LinkState&) const = default;
};
/// Of each link of the robot.
using ModelState = std::vector<std::shared_ptr<const LinkState>>;

struct Edit {
    enum class Kind {
        move,   ///< gives a sphere another centre or radius
        add,    ///< adds a sphere, pinned
        remove, ///< removes a sphere
        pin,    ///< pins a sphere, or lets it go
        more,   ///< doubles the link's weight and searches for the next larger candidate count of spheres
        fewer,  ///< halves the weight and searches for the next smaller one
        again,  ///< searches for as many spheres as the link has, around those that are pinned
        close,  ///< grows spheres until they cover the link
        count,  ///< searches for spheres of the whole robot: at most `spheres`
    };
    Kind kind = Kind::move;
    std::size_t model = 0, link = 0, index = 0;
    Sphere sphere{};         ///< move, add: in the link's frame, m
    bool pinned = false;     ///< pin
    std::size_t spheres = 0; ///< count
};

/// What a change did: the links of a model with other spheres, pins or weights; and the session right after it,
/// whatever has changed since.
struct Change {
    std::size_t model = 0;
    std::vector<std::size_t> links;
    ModelState state; ///< of the model
    std::size_t version = 0;
    bool can_undo = false, can_redo = false;
};

/// A file format that the session can write.
struct SaveFormat {
    std::string name, extension, reader; ///< reader: the program that reads it
};

struct Saved {
    std::vector<std::filesystem::path> files;
    std::string statement; ///< what is proved of them
};

/// All functions may be called from any thread; a change waits for the one before it.
class Session {
public:
    /// Takes over the subject. `folder`: where files are saved. The registry must outlive the session.
    Session(Subject subject, SubjectOptions options, Registry& registry, std::filesystem::path folder);
    ~Session();
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

    const Subject& subject() const;
    /// Grows with each change.
    std::size_t version() const;
    bool can_undo() const;
    bool can_redo() const;
    ModelState state(std::size_t model) const;
    /// Returns the candidate counts for the spheres of a robot; empty if its geometry is not known.
    std::vector<std::size_t> counts(std::size_t robot) const;

    /// Makes the edit if `version` is the session's; a search of a link ends within a second with its best spheres.
    /// Throws Error(usage), and changes nothing, for another version, for what does not exist, for a sphere that is not
    /// finite, is farther than 1e6 m or has no radius, and for a search without known geometry; other errors as the
    /// search.
    Change apply(const Edit& edit, std::size_t version);
    /// Takes the last change back. Throws Error(usage) if there is none, or for another version.
    Change undo(std::size_t version);
    Change redo(std::size_t version);

    /// Returns what is proved of a link; nothing if its geometry is not known.
    std::optional<LinkVerdict> verdict(std::size_t model, std::size_t link);
    /// Returns the same for the link as the change has left it.
    std::optional<LinkVerdict> verdict(const Change& change, std::size_t link);
    /// Returns the same for all links of a model.
    LinkVerdicts verdicts(std::size_t model);
    /// Returns the pairs of links of a model that never need a collision check.
    LinkPairs ignored(std::size_t model);
    /// Returns how far each sphere of a model protrudes; nothing if its geometry is not known. Links without geometry
    /// have infinite protrusions.
    std::optional<ModelFigures> figures(std::size_t model);

    /// Returns the formats of save(), "recipe" among them.
    std::vector<SaveFormat> formats() const;
    /// Writes a model to `file` in the session's folder. Format "recipe": a recipe that keeps all spheres, and gives
    /// them again. Throws Error(usage) for an unknown format, a name with a folder in it, a file that exists unless
    /// `replace`, one of inputs_of(), a recipe of spheres that do not cover their links, and what names a robot or mesh
    /// without a name; Error(output).
    Saved save(std::size_t model, const std::string& format, const std::string& file, bool replace);

    /// Ends searches, for good.
    void stop();

private:
    struct Data;
    std::unique_ptr<Data> data_;
};

/// Returns how far each sphere protrudes from the links of a robot; as Session::figures().
ModelFigures figures_of(const ViewedRobot& robot, const Original& original,
                        const std::vector<std::vector<Sphere>>& spheres);
/// Returns the verdict on the spheres of a link.
LinkVerdict verdict_of(const Solid& solid, const std::vector<Sphere>& spheres);
/// Returns the verdict on each link of a robot.
LinkVerdicts verdicts_of(const ViewedRobot& robot, const Original& original,
                         const std::vector<std::vector<Sphere>>& spheres);
/// Returns the pairs of links that never need a check. `original`: null where the geometry is not known.
LinkPairs ignored_pairs_of(const ViewedRobot& robot, const Original* original,
                           const std::vector<std::vector<Sphere>>& spheres,
                           const std::atomic<bool>* cancel = nullptr);
/// Returns at most `count` spheres for a whole robot. `state`: the pinned spheres are kept and the weights count.
/// Throws as a run does.
std::vector<std::vector<Sphere>> spheres_of(const ViewedRobot& robot, const SubjectOptions& options, Registry& registry,
                                            std::size_t count, const ModelState& state = {},
                                            const std::atomic<bool>* cancel = nullptr);
/// Returns candidate counts for the spheres of a robot, from one a link upwards; empty if its geometry is not known.
std::vector<std::size_t> candidate_counts(const ViewedRobot& robot);

} // namespace view
} // namespace foam
