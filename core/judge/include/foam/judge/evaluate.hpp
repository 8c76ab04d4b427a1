// Evaluation of sphere models against their original geometry: any program's model of a robot or a mesh.
#pragma once

#include <foam/geometry/measure.hpp>
#include <foam/geometry/solid.hpp>
#include <foam/recipe/mesh_unit.hpp>
#include <foam/robot/proved_links.hpp>
#include <foam/robot/robot.hpp>
#include <foam/runtime/run.hpp>
#include <foam/sdk/model.hpp>
#include <foam/sdk/registry.hpp>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] judge {

/// The radii of a file in which a buffer (cuRobo, XRDF) is added to them.
enum class Radii {
    as_used,    ///< with the buffer, as the program has them that uses the file
    as_written, ///< without
};

/// Reads a sphere model with the model reader that recognises it, or with `reader` ("read.curobo") if that is not
/// empty. Spheres whose radius is not above 0 are switched off (cuMotion): they are left out, with a note. Throws
/// Error(input) naming file, line and remedy: also if no reader recognises the file, or several do; Error(usage) for an
/// unknown reader. `name`: that its content goes by, as in parse_sphere_file(); empty: the file's own.
SphereFile read_sphere_file(const std::filesystem::path& file, const Registry& registry,
                            const std::string& reader = "", Radii radii = Radii::as_used,
                            const std::filesystem::path& name = {});

/// Reads a sphere model from memory; `file`: its name in messages, and the base of relative references.
SphereFile parse_sphere_file(const std::string& text, const std::filesystem::path& file, const Registry& registry,
                             const std::string& reader = "", Radii radii = Radii::as_used);

/// The original geometry of one link.
struct OriginalLink {
    std::string link;
    std::shared_ptr<const Solid> solid; ///< in the link's frame, metres
};

/// A robot, or a single mesh as a robot of one link.
struct Original {
    std::filesystem::path file;
    std::shared_ptr<const Robot> robot;
    /// The geometry that the links are judged by; it stands in the robot as collision geometry.
    CoveredGeometry geometry = CoveredGeometry::collision;
    std::vector<std::string> collision_only; ///< links that lose their collision geometry thereby
    std::vector<OriginalLink> links;         ///< those with such geometry, in the robot's order
    std::vector<std::string> notes;  ///< warnings of its loaders
    /// What was read, for runs on the same robot: RunOptions::input. With the meshes, if they are to be kept.
    std::shared_ptr<const LoadedInput> loaded{};
};

struct OriginalOptions {
    std::vector<std::string> links{}; ///< globs of the links to read; none: all
    MeshUnit unit{};                  ///< of a mesh whose file does not state it
    CoveredGeometry geometry = CoveredGeometry::collision;
    Covers covers = Covers::solid; ///< what elements are to hold
    std::vector<std::filesystem::path> package_path{}; ///< folders with packages, before those of the environment
    /// The name that the content of a URDF goes by: messages have it, and relative references lead from its folder. It
    /// need not exist; empty: the file's own.
    std::filesystem::path name{};
    bool keep_meshes = false; ///< in Original::loaded: nothing is read again
    std::vector<std::string> skip{}; ///< globs of links that are not read, of those that `links` chooses
    JointValues held{};              ///< joints that stand still in Original::robot; rad or m
};

/// Reads a URDF, or a mesh if a mesh loader reads the file's ending. Throws Error(input) if the file or a mesh of it
/// cannot be read or if no link remains to evaluate; Error(usage) if a glob matches no link, for a joint that cannot be
/// held, and for a unit of a file that states its own.
Original load_original(const std::filesystem::path& file, const Registry& registry,
                       const OriginalOptions& options = {});
/// Returns the original geometry of a robot that was read; meshes that were not kept are read. Of the options, links,
/// skip, held, geometry and keep_meshes count. Errors as load_original().
Original original_of(std::shared_ptr<const LoadedInput> loaded, const Registry& registry,
                     const OriginalOptions& options = {});

/// Old and new beginning of link names: a link called `first` is renamed to `second`; of the others, those that begin
/// with `first` begin with `second` instead. "" is the link of a format without link names.
using Renames = std::vector<std::pair<std::string, std::string>>;

/// Renames the links of a file.
void rename_links(SphereFile& file, const Renames& renames);

/// A sphere model matched to the links of an original.
struct MatchedModel {
    SphereFile file;
    std::vector<Elements> elements; ///< of each link of the original; empty: none
    std::vector<std::string> notes; ///< notes of the file, and what is not evaluated
};

/// Matches links by name. A link that the robot lacks is matched to the link that it is fixed to, if the file names
/// one. Spheres of a format without link names belong to the only link. Throws Error(input) if no link is in both, and
/// for spheres without a link if the robot has several.
MatchedModel match(const Original& original, SphereFile file, const Renames& renames = {});

/// The figures of a link or of the whole robot.
struct Figures {
    Measures measures;
    double covered_error = 0; ///< standard error of covered
};

struct Evaluation {
    std::vector<Figures> links; ///< of each link of the original
    Figures total;              ///< over all of them
    Figures with_spheres;       ///< over those that have spheres
};

/// Computes the figures. Equal seeds give equal figures on any number of threads. The seed of each link depends on its
/// name.
Evaluation evaluate(const Original& original, const MatchedModel& model, std::uint64_t seed = 0);

/// The result of the proof for one link.
struct LinkProof {
    bool holds = false;
    double growth = 0; ///< m; outer: of the nearest sphere, to close the worst piece; inner: how far one protrudes
    Vec3 witness{};    ///< outer: a corner of that piece, inner: the centre of that sphere; link frame
    std::uint32_t triangle = 0; ///< outer: of Solid::surface()
    bool cavity = false;        ///< outer: the surface is covered; the witness is inside, and `growth` its distance
    std::size_t sphere = 0;     ///< inner: its index among the link's spheres
    std::size_t triangles = 0;  ///< outer: of the surface; round primitives by the polyhedron around them
    std::size_t pieces = 0;     ///< outer: triangles, and parts of them, that were examined
    std::uint32_t halvings = 0; ///< outer: of the smallest of these; 0 where elements are not all spheres
};

/// Returns one result per link of the original. For `outer` a link without spheres is not covered; for `inner` it
/// passes. Throws Error(usage) for Guarantee::fitted, for which there is no proof, and for Guarantee::inner with
/// elements of other kinds than sphere.
std::vector<LinkProof> prove(const Original& original, const MatchedModel& model, Guarantee guarantee);

/// The reasons in ProvedLinks for a link whose proof does not hold, and for one that has nothing to prove with.
inline constexpr const char* proof_fails = "the proof does not hold";
inline constexpr const char* no_elements = "it has no elements";
/// Returns the verdict on a model. `proved`: of each link of the original.
ProvedLinks proved_links(const Original& original, const MatchedModel& model, const std::vector<LinkProof>& proofs,
                         Guarantee guarantee);
/// Returns the verdict of an evaluation: of Guarantee::outer.
ProvedLinks proved_links(const Original& original, const MatchedModel& model, const Evaluation& evaluation);

} // namespace judge
} // namespace foam
