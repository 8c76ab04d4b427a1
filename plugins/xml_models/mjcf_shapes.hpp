// Elements as geoms and mesh assets of MJCF.
#pragma once

#include <foam/sdk/elements.hpp>

#include <string>
#include <vector>

namespace foam::xml_models {

/// Writes geoms, and the mesh assets of their hulls.
class MjcfShapes {
public:
    /// `first`: number of the first mesh, whose name is "foam_hull_FIRST".
    explicit MjcfShapes(std::size_t first = 1) : next_(first) {}

    /// Returns ` type=… size=… pos=… quat=…`, the attributes of the geom of an element of a kind that MJCF knows.
    std::string attributes(const Element& element);
    /// Returns the `<mesh …/>` of the hulls so far. Their corners stand in the file: there is no other file to lose.
    const std::vector<std::string>& meshes() const { return meshes_; }

private:
    std::size_t next_;
    std::vector<std::string> meshes_;
};

/// What a name of a mesh of foam begins with.
constexpr const char* hull_prefix = "foam_hull_";

} // namespace foam::xml_models
