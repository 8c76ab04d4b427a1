#include "mjcf_shapes.hpp"

#include "attributes.hpp"

#include <foam/base/error.hpp>
#include <foam/geometry/element_forms.hpp>
#include <foam/geometry/mesh.hpp>
#include <foam/geometry/vector.hpp>

#include <array>

namespace foam::xml_models {
namespace {

using Kind = Element::Kind;

std::string pose_attributes(const Pose& pose, const std::array<double, 4>& quat) {
    return attribute_text("pos", vector_text(pose.translation)) +
           (pose.rotation == Pose{}.rotation ? "" : attribute_text("quat", numbers_text(quat)));
}

/// Throws for a hull whose mesh MuJoCo refuses ("mesh volume is too small").
void require_volume(const Element& hull) {
    constexpr double least = 1e-14; // m³; mjMINVAL is 1e-15
    if (signed_volume(hull.hull->surface) < least) {
        throw Error(ErrorCode::output, "write.mjcf: MuJoCo refuses a hull with a volume of less than 1e-14 m³; remedy: "
                                       "another kind of element for this link, or other units");
    }
}

} // namespace

std::string MjcfShapes::attributes(const Element& element) {
    if (element.kind == Kind::hull) {
        require_volume(element);
        const std::string name = hull_prefix + std::to_string(next_++);
        std::string corners;
        for (const Vec3& p : element.hull->surface.vertices) {
            corners += (corners.empty() ? "" : " ") + vector_text(p);
        }
        meshes_.push_back("<mesh" + attribute_text("name", name) + attribute_text("vertex", corners) + "/>");
        return attribute_text("type", "mesh") + attribute_text("mesh", name) +
               attribute_text("pos", vector_text(element.pose.translation));
    }
    const std::array<double, 4> quat = quaternion(element.pose); // w x y z, as MuJoCo's
    const Element stated = stated_at(element, from_quaternion(element.pose.translation, quat));
    const std::string size = stated.kind == Kind::box ? vector_text(stated.half) // half the edges
                                                      : numbers_text(std::array{stated.radius, stated.half.z});
    return attribute_text("type", to_string(stated.kind)) + attribute_text("size", size) +
           pose_attributes(element.pose, quat);
}

} // namespace foam::xml_models
