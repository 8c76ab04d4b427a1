#include "reader.hpp"

#include <foam/base/error.hpp>
#include <foam/base/text.hpp>
#include <foam/geometry/element_forms.hpp>
#include <foam/sdk/elements.hpp>
#include <foam/xml/document.hpp>

#include <fmt/format.h>

#include <set>

namespace foam::urdf {

/// Returns macros of collision elements, as write.xacro writes them, as links of a URDF on the same lines. Joints that
/// mean nothing hold the links together.
static std::string links_of_macros(const std::string& text, const std::filesystem::path& file) {
    constexpr std::string_view suffix = "_collision", end_tag = "</xacro:macro>";
    const auto root = xml::parse(text, file.string(), ErrorCode::input);
    std::string result, first;
    std::size_t done = 0;
    for (const xml::Element* macro : root->children_named("xacro:macro")) {
        const std::string* name = macro->attribute("name");
        if (!name || !name->ends_with(suffix) || macro->self_closing()) {
            continue; // the loader says what it is
        }
        const std::string link = name->substr(0, name->size() - suffix.size());
        result += text.substr(done, macro->start_tag.begin - done) + fmt::format("<link name=\"{}\">", link) +
                  text.substr(macro->start_tag.end, macro->end_tag - macro->start_tag.end) + "</link>";
        if (first.empty()) {
            first = link;
        } else {
            result += fmt::format(R"(<joint name="{0}" type="fixed"><parent link="{1}"/><child link="{0}"/></joint>)",
                                  link, first);
        }
        done = macro->end_tag + end_tag.size();
    }
    return result + text.substr(done);
}

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
    std::vector<Element> found;
    for (const GeometryElement& collision : link.collisions) {
        if (const auto* primitive = std::get_if<Element>(&collision.geometry)) {
            found.push_back(moved(*primitive, collision.origin));
            continue;
        }
        std::string why;
        if (auto hull = read_hull(std::get<MeshReference>(collision.geometry), why, context)) {
            hull->pose = collision.origin;
            found.push_back(*hull);
        } else {
            left_out.insert(why);
        }
    }
    if (!left_out.empty()) {
        result.notes.push_back(fmt::format("link '{}' has collision geometry that is no convex element ({}), which is "
                                           "not judged",
                                           link.name, fmt::join(left_out, ", ")));
    }
    if (!found.empty()) {
        result.links.push_back({link.name, with_joined_capsules(found)});
    }
}

SphereReader::SphereReader(const Parameters&, const StageMaker& maker)
    : loader_(maker.make<RobotLoader>("load.urdf", {{"lenient", true}})), meshes_(maker.make<MeshLoader>("load.mesh")) {
}

bool SphereReader::recognises(std::string_view text) const {
    // An SRDF also begins with <robot>.
    return root_name_of(text) == "robot" && text.find("<link_sphere_approximation") == text.npos;
}

SphereFile SphereReader::read(const std::string& text, const std::filesystem::path& file, Context& context) const {
    const bool macros = text.find("<xacro:macro") != text.npos;
    const Robot robot = loader_->load(macros ? links_of_macros(text, file) : text, file,
                                      ResourceResolver::from_environment(), context);
    SphereFile result;
    result.file = file;
    result.format = "URDF";
    for (const Link& link : robot.links) {
        read_link(link, result, context);
    }
    for (const Joint& joint : robot.joints) {
        if (joint.kind == Joint::Kind::fixed && !macros) {
            result.fixed_joints[joint.child] = {joint.parent, joint.origin};
        }
    }
    return result;
}

} // namespace foam::urdf
