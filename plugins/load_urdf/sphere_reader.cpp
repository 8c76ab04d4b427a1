#include "sphere_reader.hpp"

#include <foam/xml/document.hpp>

#include <fmt/format.h>

#include <set>

namespace foam::urdf {
namespace {

std::string kind_of(const Geometry& geometry) {
    const auto* primitive = std::get_if<Primitive>(&geometry);
    return primitive ? to_string(primitive->kind) : "mesh";
}

void read_link(const Link& link, SphereFile& result) {
    std::set<std::string> others;
    std::vector<Sphere> spheres;
    for (const GeometryElement& element : link.collisions) {
        const auto* primitive = std::get_if<Primitive>(&element.geometry);
        if (primitive && primitive->kind == Primitive::Kind::sphere) {
            spheres.push_back({element.origin.translation, primitive->radius});
        } else {
            others.insert(kind_of(element.geometry));
        }
    }
    if (!others.empty()) {
        result.notes.push_back(
            fmt::format("link '{}' has collision geometry other than spheres ({}), which is not judged", link.name,
                        fmt::join(others, ", ")));
    }
    if (!spheres.empty()) {
        result.links.push_back({link.name, std::move(spheres)});
    }
}

} // namespace

SphereReader::SphereReader(const Parameters&, const StageMaker& maker)
    : loader_(maker.make<RobotLoader>("load.urdf", {{"lenient", true}})) {}

bool SphereReader::recognises(std::string_view text) const {
    // An SRDF also begins with <robot>.
    return xml::root_name(text) == "robot" && text.find("<link_sphere_approximation") == text.npos;
}

SphereFile SphereReader::read(const std::string& text, const std::filesystem::path& file, Context& context) const {
    const Robot robot = loader_->load(text, file, ResourceResolver::from_environment(), context);
    SphereFile result;
    result.file = file;
    result.format = "URDF";
    for (const Link& link : robot.links) {
        read_link(link, result);
    }
    for (const Joint& joint : robot.joints) {
        if (joint.kind == Joint::Kind::fixed) {
            result.fixed_joints[joint.child] = {joint.parent, joint.origin};
        }
    }
    return result;
}

} // namespace foam::urdf
