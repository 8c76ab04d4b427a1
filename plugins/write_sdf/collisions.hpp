// The <collision> elements of a link.
#pragma once

#include <foam/sdk/elements.hpp>

#include <string>
#include <vector>

namespace foam::sdf {

/// Returns three numbers with blanks between them.
std::string vector_text(const Vec3& v);
/// Returns a <pose>, in the frame that holds where it stands, or in another.
std::string pose_text(const Pose& pose, const std::string& relative_to = "");
/// Returns the shape of a primitive at its pose, within <geometry>.
std::string shape_text(const Element& primitive);

/// A <collision>, in parts.
struct CollisionText {
    std::string name;     ///< "capsule_3"
    std::string pose;     ///< <pose>, in the frame of the link
    std::string geometry; ///< <geometry>
};

/// Returns those of a link's elements, spheres first. `hulls`: names of the meshes of hulls.
std::vector<CollisionText> collisions_of(const LinkSpheres& link, HullNames& hulls);

} // namespace foam::sdf
