#include "octree.hpp"

#include "soup.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/base/error.hpp>

#include <fmt/format.h>

namespace foam::repair {
namespace {

/// The share of the unit cube's edge that the longest extent takes: the surface does not touch the cube.
constexpr double filled = 0.998;

/// Distances from the input, in cells. Solids: small compared with the error of the resolution. Sheets: enough for both
/// sides where they are curved.
constexpr double off_solids = 0.005, off_sheets = 0.1;

/// The map between the mesh's frame and the unit cube.
struct Frame {
    Vec3 center;
    double scale;

    explicit Frame(const Box& box) : center(box.center()) {
        const Vec3 size = box.size();
        scale = std::max({size.x, size.y, size.z}) / filled;
    }
    Vec3 in(const Vec3& p) const { return (p - center) / scale + Vec3{0.5, 0.5, 0.5}; }
    Vec3 out(const Vec3& p) const { return (p - Vec3{0.5, 0.5, 0.5}) * scale + center; }
};

} // namespace

Mesh rebuilt(const Mesh& mesh, const RebuildOptions& options, Context& context) {
    const Frame frame(bounds(mesh));
    Mesh input = mesh;
    for (Vec3& p : input.vertices) {
        p = frame.in(p);
    }
    Octree octree(input, options.leaves, context);
    const std::shared_ptr<const Solid> solid = Solid::make(input);
    if (options.fill_openings && !solid->closed()) {
        fill_openings(octree, *solid, context);
    }
    flood_from_outside(octree);
    context.metric("occupied_cells", static_cast<double>(octree.occupied()), "1");
    const VoxelSurface voxels = voxel_surface(octree, context);
    const Nearby nearby(input, voxels, octree);

    // Thin curved sheets could become inside out if their two sides came too near to each other: then a larger
    // distance.
    for (double factor = 1; factor < 8; factor *= 2) {
        check_cancelled();
        VoxelSurface surface = voxels;
        const ProjectOptions distances = {.off_solids = factor * off_solids, .off_sheets = factor * off_sheets};
        const double sheets = project(surface, nearby, *solid, octree.cell_size(), distances, context);
        const std::size_t back = untangle(surface.mesh, voxels.mesh, context);
        if (signed_volume(surface.mesh) > 0) {
            context.metric("vertices_untangled", static_cast<double>(back), "1");
            if (sheets > 0.01) {
                context.log(
                    Severity::info,
                    fmt::format(
                        "about {:.0f} % of the surface has no inside: it became a solid about {:.3g} of the size thick",
                        100 * sheets, 2 * distances.off_sheets * octree.cell_size() * filled));
            }
            for (Vec3& p : surface.mesh.vertices) {
                p = frame.out(p);
            }
            return std::move(surface.mesh);
        }
    }
    throw Error(ErrorCode::internal, "repair.watertight: the surface drawn to the input encloses no volume");
}

} // namespace foam::repair
