// The report of a run: its scene, and the page with it.
#pragma once

#include <foam/base/internal/embedded_text.hpp>
#include <foam/geometry/mesh.hpp>
#include <foam/geometry/sphere.hpp>

#include <nlohmann/json.hpp>

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] report {

/// The mesh of a link after a stage; link frame.
struct StageMesh {
    std::string stage; ///< "original", "repair.auto", …
    std::shared_ptr<const Mesh> mesh;
};

struct SceneLink {
    std::string name;
    Pose pose;                     ///< from its frame to the robot's
    std::vector<StageMesh> meshes; ///< the original first
    std::vector<Elements> levels;  ///< coarse to fine; link frame
};

/// A mesh with corners on a grid, for a 16-bit vertex buffer.
struct GridMesh {
    Vec3 low;        ///< corner (0, 0, 0)
    double step = 0; ///< m, from one corner to the next
    std::vector<std::array<std::uint16_t, 3>> corners;
    std::vector<Triangle> triangles;
};

/// Moves the corners to the nearest point of a grid with 2^bits points per side around the mesh and merges them.
/// Removes degenerate and duplicate triangles (vertex clustering: Rossignac and Borrel, 1993).
GridMesh on_grid(const Mesh& mesh, int bits);

/// Returns the upper three rows of the matrix of a pose, one behind the other.
inline std::array<double, 12> rows_of(const Pose& pose) {
    const auto& [x, y, z] = pose.rotation;
    const Vec3& t = pose.translation;
    return {x.x, x.y, x.z, t.x, y.x, y.y, y.z, t.y, z.x, z.y, z.z, t.z};
}

/// Returns the scene. `max_triangles`: over all distinct meshes. If there are more, those with most are reduced.
///
/// {"links": [{"name", "pose": 3 rows of 4 numbers, "meshes": [index, …], "levels": [float32 x, y, z, radius, …],
///             "elements": [[{"kind", "mesh": index}, …], …]}, …],
///  "meshes": [{"low", "step", "wide", "corners": uint16 × 3, "triangles": uint16 × 3, or uint32 × 3 if wide}, …],
///  "drawn": share of the triangles}. "elements": of other kinds than sphere, by level; only where there are some.
/// Little-endian. No '<' in it: it may stand in a script element.
std::string scene_json(const std::vector<SceneLink>& links, std::size_t max_triangles);

/// Returns a source of a Content Security Policy: only the text with this digest.
std::string policy_source(const EmbeddedText& text);

struct ReportLink {
    SceneLink scene;
    std::string spherizer; ///< the stage that made its spheres
};

struct Report {
    nlohmann::ordered_json manifest;
    std::string recipe;             ///< as YAML, with every default
    std::string name;               ///< of the robot or mesh
    std::vector<ReportLink> links;  ///< links with spheres, in the robot's order
    std::string picture;            ///< PNG of the robot; may be empty
    std::vector<std::string> files; ///< further files of the run directory for people
};

/// Returns the report. Equal reports give equal bytes. What may differ between two runs of a recipe (see manifest.hpp)
/// is between the comments <!--execution--> and <!--/execution-->.
std::string to_html(const Report& report);

} // namespace report
} // namespace foam
