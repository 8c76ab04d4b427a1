#include "object.hpp"

#include "links.hpp"

#include <foam/base/error.hpp>
#include <foam/base/text.hpp>
#include <foam/geometry/vector.hpp>
#include <foam/xml/document.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <optional>
#include <set>

namespace foam::sdf {
namespace {

using Node = xml::Element;

/// Reads links of models within models.
class Reader {
public:
    Reader(std::string_view text, const std::filesystem::path& file, const MeshText& mesh_text, bool own)
        : text_(text), mesh_text_(mesh_text), own_(own), result_{.file = file, .format = "SDF", .links = {}, .fixed_joints = {}, .notes = {}} {}

    SphereFile read() {
        const auto root = xml::parse(text_, result_.file.string(), ErrorCode::input);
        if (root->name != "sdf") {
            fail(*root, fmt::format("the root element is <{}>, not <sdf>", root->name));
        }
        const auto links = links_of(*root, result_.file.string());
        for (const auto& [name, link] : links) {
            read_link(*link, name);
        }
        return std::move(result_);
    }

private:
    [[noreturn]] void fail(const Node& at, const std::string& why) const {
        throw Error(ErrorCode::input, fmt::format("{}:{}: {}", result_.file.string(), at.line, shown(why)));
    }

    void read_link(const Node& link, const std::string& name) {
        const std::string& own_name = *link.attribute("name");
        std::set<std::string> left_out;
        Elements elements;
        std::size_t masked = 0;
        for (const Node* collision : link.children_named("collision")) {
            if (is_masked(*collision, text_)) {
                ++masked;
                continue;
            }
            const Node* geometry = collision->child("geometry");
            const Node* shape = geometry && !geometry->children.empty() ? geometry->children.front().get() : nullptr;
            std::optional<Element> element = shape ? read_shape(*shape) : std::nullopt;
            if (!element) {
                left_out.insert(shape ? shape->name : "none");
                continue;
            }
            const Node* pose = collision->child("pose");
            const std::string* frame = pose ? pose->attribute("relative_to") : nullptr;
            if (frame && !frame->empty() && *frame != own_name && own_) {
                left_out.insert(shape->name); // none that foam wrote
                continue;
            }
            if (frame && !frame->empty() && *frame != own_name) {
                fail(*pose, fmt::format("the {} is placed in the frame '{}'; remedy: give its place in the frame of "
                                        "its link, without relative_to",
                                        to_string(element->kind), *frame));
            }
            element->pose = pose ? read_pose(*pose) : Pose{};
            elements.add(*element);
        }
        if (!left_out.empty()) {
            result_.notes.push_back(
                fmt::format("link '{}' has collision geometry that is no convex element ({}), which is not judged",
                            name, fmt::join(left_out, ", ")));
        }
        if (masked > 0) {
            result_.notes.push_back(fmt::format("link '{}': {} collision{} left out: with <collide_bitmask> 0 a simulator "
                                                "lets {} pass through everything",
                                                name, masked, masked == 1 ? " is" : "s are",
                                                masked == 1 ? "it" : "them"));
        }
        if (elements.size() > 0) {
            link_of(result_, name).elements.add(elements);
        }
    }

    /// Returns the element of a shape, at the origin; nothing for one that is no convex element.
    std::optional<Element> read_shape(const Node& shape) const {
        using Kind = Element::Kind;
        if (shape.name == "sphere") {
            return Element{.kind = Kind::sphere, .radius = number_in(shape, "radius")};
        }
        if (shape.name == "capsule" || shape.name == "cylinder") {
            return Element{.kind = shape.name == "capsule" ? Kind::capsule : Kind::cylinder,
                           .half = {0, 0, number_in(shape, "length") / 2},
                           .radius = number_in(shape, "radius")};
        }
        if (shape.name == "box") {
            return Element::box(three_in(shape, "size"));
        }
        if (shape.name == "ellipsoid") {
            return Element::ellipsoid(three_in(shape, "radii"));
        }
        return shape.name == "mesh" ? read_hull(shape) : std::nullopt;
    }

    /// Returns the hull of a mesh file that is there, of foam's name.
    std::optional<Element> read_hull(const Node& mesh) const {
        const Node* uri = mesh.child("uri");
        if (!uri || mesh.child("scale") || mesh.child("submesh")) {
            return {};
        }
        const std::string_view content = content_of(*uri, text_);
        const std::string name(words(content).empty() ? std::string_view() : words(content).front());
        const std::string text = mesh_text_(name);
        try {
            return text.empty() ? std::nullopt : std::optional(hull_of(text));
        } catch (const Error& error) {
            fail(*uri, fmt::format("{}: {}", name, error.what()));
        }
    }

    std::vector<double> numbers(const Node& element) const {
        std::vector<double> result;
        for (const std::string_view word : words(content_of(element, text_))) {
            const std::optional<double> value = parse_number(word);
            if (!value) {
                fail(element, fmt::format("<{}>: '{}' is not a finite number", element.name, word));
            }
            result.push_back(*value);
        }
        return result;
    }

    Pose read_pose(const Node& pose) const {
        const std::vector<double> v = numbers(pose);
        const std::string* format = pose.attribute("rotation_format");
        const std::string* degrees = pose.attribute("degrees");
        if (!v.empty() && v.size() != (format && *format == "quat_xyzw" ? 7 : 6)) {
            fail(pose, fmt::format("<pose> has {} numbers; expected are 6, or 7 with rotation_format=\"quat_xyzw\"",
                                   v.size()));
        }
        if (v.empty()) {
            return {};
        }
        const Vec3 place{v[0], v[1], v[2]};
        if (v.size() == 7) {
            if (v[3] == 0 && v[4] == 0 && v[5] == 0 && v[6] == 0) {
                fail(pose, "a quaternion of zeros is no rotation");
            }
            return from_quaternion(place, {v[6], v[3], v[4], v[5]});
        }
        const double unit = degrees && (*degrees == "true" || *degrees == "1") ? std::numbers::pi / 180 : 1;
        return Pose::from_xyz_rpy(place, Vec3{v[3], v[4], v[5]} * unit);
    }

    Vec3 three_in(const Node& shape, std::string_view name) const {
        const Node* element = shape.child(name);
        const std::vector<double> values = element ? numbers(*element) : std::vector<double>{};
        if (values.size() != 3) {
            fail(element ? *element : shape,
                 fmt::format("{} needs a <{}> of three numbers", with_article(shape.name), name));
        }
        return {values[0], values[1], values[2]};
    }

    double number_in(const Node& shape, std::string_view name) const {
        const Node* element = shape.child(name);
        const std::vector<double> values = element ? numbers(*element) : std::vector<double>{};
        if (values.size() != 1) {
            fail(element ? *element : shape, fmt::format("{} needs one <{}>", with_article(shape.name), name));
        }
        return values.front();
    }

    std::string_view text_;
    const MeshText& mesh_text_;
    bool own_;
    SphereFile result_;
};

} // namespace

bool is_sdf(std::string_view text) {
    return xml::root_name(text) == "sdf";
}

SphereFile read_sdf(const std::string& text, const std::filesystem::path& file, const MeshText& mesh_text, bool own) {
    return Reader(text, file, mesh_text, own).read();
}

} // namespace foam::sdf
