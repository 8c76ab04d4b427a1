// Links as a URDF or a mesh file gives them, and the spheres of a written file.
#pragma once

#include "vector.hpp"

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace judge {

struct Ball {
    Point center;
    Real radius = 0;
};

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

/// Spheres by link: of a URDF, whose collision elements must all be spheres but for the links `without`, or of a CSV
/// with the columns link, x, y, z and radius. Throws std::runtime_error.
std::map<std::string, std::vector<Ball>> read_spheres(const std::filesystem::path& file,
                                                      const std::set<std::string>& without = {});

} // namespace judge
