// Sphere models judged against the geometry that they stand for: anybody's model of a robot or a mesh.
#pragma once

#include <foam/host/mesh_unit.hpp>
#include <foam/host/sphere_file.hpp>
#include <foam/measure.hpp>
#include <foam/robot.hpp>
#include <foam/solid.hpp>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace foam {

/// The collision geometry of one link as its file gives it.
struct OriginalLink {
    std::string link;
    std::shared_ptr<const Solid> solid; ///< in the link's frame, metres
};

/// A robot, or a single mesh as a robot of one link.
struct Original {
    std::filesystem::path file;
    std::shared_ptr<const Robot> robot;
    std::vector<OriginalLink> links; ///< those with collision geometry, in the robot's order
    std::vector<std::string> notes;  ///< what its loaders warned of
};

/// As long as it lives, parallel work takes at most so many threads; 0: one a core.
class ThreadLimit {
public:
    explicit ThreadLimit(std::size_t threads);
    ~ThreadLimit();
    ThreadLimit(const ThreadLimit&) = delete;
    ThreadLimit& operator=(const ThreadLimit&) = delete;

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// Reads a URDF, or a mesh if a mesh loader takes the file's ending. `links`: globs of those to read; none: all. Throws
/// Error(input) if the file or a mesh of it cannot be read, if nothing is left to judge, or a glob names no link;
/// Error(usage) for a unit of a file that has its own.
Original load_original(const std::filesystem::path& file, const Registry& registry,
                       const std::vector<std::string>& links = {}, const MeshUnit& unit = {});

/// Old and new beginning of link names: a link called `first` is called `second`; of the others those that begin with
/// `first` begin with `second` instead. "" stands for the link of a format that names none.
using Renames = std::vector<std::pair<std::string, std::string>>;

/// A sphere model brought onto the links of an original.
struct MatchedModel {
    SphereFile file;
    std::vector<std::vector<Sphere>> spheres; ///< of each link of the original; empty: none
    std::vector<std::string> notes;           ///< the file's, and what of it is not judged
};

/// Links by name. A link that the robot lacks goes with the one that it is fixed to, if the file says so. Spheres of a
/// format that names no link belong to the only link. Throws Error(input) if no link is in both, and for spheres
/// without a link beside several.
MatchedModel match(const Original& original, SphereFile file, const Renames& renames = {});

/// The figures of a link or of the whole.
struct Figures {
    Measures measures;
    double covered_error = 0; ///< standard error of covered
};

struct Evaluation {
    std::vector<Figures> links; ///< of each link of the original
    Figures total;              ///< over all of them
    Figures with_spheres;       ///< over those that have spheres
};

/// Same seed, same figures, on any number of threads. Each link is measured by a seed of its own name.
Evaluation evaluate(const Original& original, const MatchedModel& model, std::uint64_t seed = 0);

/// What stands in the way of a proof, or nothing.
struct LinkProof {
    bool holds = false;
    double growth = 0; ///< m; outer: of the nearest sphere, to close the worst piece; inner: how far one sticks out
    Vec3 witness{};    ///< outer: a corner of that piece, inner: the centre of that sphere; link frame
    std::uint32_t triangle = 0; ///< outer: of Solid::surface()
    std::size_t sphere = 0;     ///< inner: its index among the link's spheres
    std::size_t triangles = 0;  ///< outer: of the surface; round primitives by the polyhedron around them
    std::size_t pieces = 0;     ///< outer: triangles and parts of them that were looked at
    std::uint32_t halvings = 0; ///< outer: of the smallest of these
};

/// One for each link of the original. A link without spheres is not covered; without spheres nothing sticks out. Throws
/// Error(usage) for Guarantee::fitted, of which there is no proof.
std::vector<LinkProof> prove(const Original& original, const MatchedModel& model, Guarantee guarantee);

} // namespace foam
