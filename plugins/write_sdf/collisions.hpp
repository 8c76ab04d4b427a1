// The <collision> elements of a link.
#pragma once

#include <foam/sdk/elements.hpp>

#include <string>
#include <vector>

namespace foam::sdf {

/// A <collision>, in parts.
struct CollisionText {
    std::string name;     ///< "capsule_3"
    std::string pose;     ///< <pose>, in the frame of the link
    std::string geometry; ///< <geometry>
};

/// Returns those of a link's elements, spheres first. `hulls`: names of the meshes of hulls.
std::vector<CollisionText> collisions_of(const LinkSpheres& link, HullNames& hulls);

} // namespace foam::sdf
