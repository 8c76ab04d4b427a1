// Links as a URDF or a mesh file gives them.
#pragma once

#include "body.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace judge {

/// One collision element in its link's frame.
struct Part {
    enum class Kind { mesh, sphere, cylinder, capsule };
    Kind kind = Kind::mesh;
    std::vector<Corners> triangles; ///< of a mesh or a box
    Real radius = 0, length = 0;    ///< of round primitives, along `axis`
    Point center, axis, across, up; ///< of round primitives; unit vectors at right angles
    /// How far a point may be from where exact arithmetic puts it, since angles and products were rounded to doubles:
    /// see placement_error().
    Real rounding = 0;
};

struct Link {
    std::string name;
    std::vector<Part> parts;
};

/// The links with collision geometry of a URDF, or a mesh as one link called "". Throws std::runtime_error.
std::vector<Link> read_original(const std::filesystem::path& file);
/// The same body as a round part.
Body body_of(const Part& part);

} // namespace judge
