// The sphere model of a robot: the input of writers.
#pragma once

#include <foam/geometry/measure.hpp>
#include <foam/geometry/sphere.hpp>
#include <foam/robot/proved_links.hpp>
#include <foam/robot/robot.hpp>

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] sdk {

/// The spheres of one link, or of one collision element of it (recipe: `per: collision`). Link frame, metres.
struct SphereGroup {
    std::string link;
    /// Geometry that the spheres cover: mesh references of the elements ("meshes/link0.stl") or the primitive's kind
    /// ("box").
    std::vector<std::string> geometries;
    /// Levels from coarse to fine, as written: grown to cover if the guarantee is outer. tree.finest() are the link's
    /// spheres.
    SphereTree tree;
    /// Figures of the finest level.
    Measures measures;
};

/// A file of the user.
struct TextFile {
    std::filesystem::path file;
    std::string text;
};

struct SphereModel {
    std::string name; ///< of the recipe
    Guarantee guarantee = Guarantee::outer;
    /// Without joints and source text where only the names of its links are known.
    std::shared_ptr<const Robot> robot;
    std::vector<SphereGroup> groups; ///< in the order of the robot's links
    /// Absolute folder of the file that is written; empty: not known. It need not exist yet.
    std::filesystem::path folder{};
    std::string file{}; ///< name of the file that is written, without folder; empty: not known
    RobotFacts facts{};
    /// Pairs that need no check, in the order of the robot's links; nothing: not computed.
    std::optional<std::vector<IgnoredPair>> ignored_pairs{};
    std::vector<std::string> without_collision{}; ///< links whose collision geometry the output leaves out
    std::string provenance{};                     ///< one line for a comment: program, source, proof; may be empty
    std::optional<TextFile> into{}; ///< the file whose spheres the writer replaces; nothing: it writes a whole file
    /// Original geometry of links, by their names, in their frames: for masses. Links whose geometry is not known are
    /// left out.
    std::map<std::string, std::shared_ptr<const Solid>> geometry{};
    /// What is proved of the model; of no link where that is not known.
    ProvedLinks verdict{};
};

/// The elements of one link, over all its groups.
struct LinkSpheres {
    std::string link;
    Elements elements;
};

/// The spheres of a file, by link: the result of readers. Metres; link frames.
struct SphereFile {
    std::filesystem::path file;
    std::string format;             ///< "URDF", "cuRobo YAML", "GPMP2 rows", …
    std::vector<LinkSpheres> links; ///< in the order of the file; a format without link names has one called ""
    /// URDF: joints that do not move, by the name of the child link. A link that only carries spheres of its parent
    /// (MorphIt) can be merged into the parent with them.
    struct FixedJoint {
        std::string parent;
        Pose origin; ///< from the child's frame to the parent's
    };
    std::map<std::string, FixedJoint> fixed_joints;
    std::vector<std::string> notes; ///< what was left out, and what the spheres alone do not state
    /// What the program that uses the file adds to the radii of a link, m. `links` hold the radii as they stand.
    std::map<std::string, double> buffers{};
};

/// Adds the buffers to the radii, as the program does that uses the file, and clears them. Spheres that a buffer switches
/// off are removed, with a note.
void add_buffers(SphereFile& file);

/// Returns the spheres of a link; adds the link at the end if it is missing.
std::vector<Sphere>& spheres_of(SphereFile& file, const std::string& link);

/// Returns the content of a model for a format without groups or trees: its links in the order of their first groups.
/// `level`: 0 the coarsest, 1 the next…; -1, or one that a tree does not reach, selects the finest of that tree. Throws
/// Error(output) for a group without spheres, and for a sphere that no reader accepts: not finite, or with a radius
/// that is not above 0.
std::vector<LinkSpheres> spheres_by_link(const SphereModel& model, int level = -1);
/// Throws the same errors for all levels, for writers of whole trees.
void require_writable(const SphereModel& model);

} // namespace sdk
} // namespace foam
