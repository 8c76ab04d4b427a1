#include "rebuild.hpp"

#include "octree.hpp"
#include "project.hpp"
#include "triangle.hpp"
#include "voxel_surface.hpp"

#include <foam/error.hpp>

#include <fmt/format.h>

namespace foam::watertight {
namespace {

/// The part of the unit cube's edge that the longest extent takes: the surface does not touch the cube.
constexpr double filled = 0.998;

/// Between the mesh's frame and the unit cube.
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
    if (options.fill_openings) {
        const std::shared_ptr<const Solid> solid = Solid::make(input);
        if (!solid->closed()) {
            fill_openings(octree, *solid, context);
        }
    }
    flood_from_outside(octree);
    context.metric("occupied_cells", static_cast<double>(octree.occupied()), "1");
    const VoxelSurface voxels = voxel_surface(octree, context);

    // Thin curved sheets could end inside out if their two sides came too near to each other: then stay further off.
    for (double stand_off = 0.02; stand_off < 0.5; stand_off *= 2) {
        VoxelSurface surface = voxels;
        project(surface, input, octree, {.stand_off = stand_off * octree.cell_size()}, context);
        if (signed_volume(surface.mesh) > 0) {
            for (Vec3& p : surface.mesh.vertices) {
                p = frame.out(p);
            }
            return std::move(surface.mesh);
        }
    }
    throw Error(ErrorCode::internal, "repair.watertight: the surface drawn to the input encloses no volume");
}

} // namespace foam::watertight
