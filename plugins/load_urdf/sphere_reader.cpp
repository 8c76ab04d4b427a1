#include "reader.hpp"

#include <foam/base/error.hpp>
#include <foam/base/text.hpp>
#include <foam/geometry/element_forms.hpp>
#include <foam/sdk/elements.hpp>
#include <foam/xml/document.hpp>

#include <fmt/format.h>

#include <set>

namespace foam::urdf {

/// Returns the hull that a mesh is; nothing with the reason if it is none.
std::optional<Element> SphereReader::read_hull(const MeshReference& mesh, std::string& why, Context& context) const {
    constexpr double most_triangles = 100'000; // of a convex piece
    if (!meshes_ || mesh.path.empty()) {
        why = mesh.path.empty() ? "a mesh that is not found" : "a mesh; no plugin has load.mesh";
        return {};
    }
    try {
        const Mesh loaded = transformed(meshes_->load(mesh.path, context), {}, mesh.scale);
        if (static_cast<double>(loaded.triangles.size()) <= most_triangles) {
            if (auto hull = hull_if_convex(loaded)) {
                Element element{.kind = Element::Kind::hull};
                element.hull = std::move(hull);
                return element;
            }
        }
        why = "a mesh that is not convex";
    } catch (const Error& error) {
        why = fmt::format("a mesh that cannot be read: {}", error.what());
    }
    return {};
}

void SphereReader::read_link(const Link& link, SphereFile& result, Context& context) const {
    std::set<std::string> left_out;
    Elements elements;
    for (const GeometryElement& collision : link.collisions) {
        if (const auto* primitive = std::get_if<Element>(&collision.geometry)) {
            elements.add(moved(*primitive, collision.origin));
            continue;
        }
        std::string why;
        if (auto hull = read_hull(std::get<MeshReference>(collision.geometry), why, context)) {
            hull->pose = collision.origin;
            elements.add(*hull);
        } else {
            left_out.insert(why);
        }
    }
    if (!left_out.empty()) {
        result.notes.push_back(fmt::format("link '{}' has collision geometry that is no convex element ({}), which is "
                                           "not judged",
                                           link.name, fmt::join(left_out, ", ")));
    }
    if (elements.size() > 0) {
        result.links.push_back({link.name, std::move(elements)});
    }
}

SphereReader::SphereReader(const Parameters&, const StageMaker& maker)
    : loader_(maker.make<RobotLoader>("load.urdf", {{"lenient", true}})), meshes_(maker.make<MeshLoader>("load.mesh")) {
}

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
        read_link(link, result, context);
    }
    for (const Joint& joint : robot.joints) {
        if (joint.kind == Joint::Kind::fixed) {
            result.fixed_joints[joint.child] = {joint.parent, joint.origin};
        }
    }
    return result;
}

} // namespace foam::urdf
