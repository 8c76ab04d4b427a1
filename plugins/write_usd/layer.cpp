#include "layer.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/base/error.hpp>
#include <foam/base/text.hpp>
#include <foam/geometry/element_forms.hpp>
#include <foam/geometry/vector.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace foam::usd {
namespace {

/// Returns the text in quotes, with the escapes of USD.
std::string literal(std::string_view text) {
    std::string result = "\"";
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (c == '"' || c == '\\') {
            result += '\\';
            result += c;
        } else if (c == '\n' || c == '\t' || c == '\r') {
            result += c == '\n' ? "\\n" : c == '\t' ? "\\t" : "\\r";
        } else if (byte < 0x20 || byte == 0x7F) {
            result += fmt::format("\\{:03o}", byte); // three digits: what follows cannot belong to it
        } else {
            result += c;
        }
    }
    return result + '"';
}

/// Writes prims within each other, indented.
class LayerWriter {
public:
    /// Begins a prim. `metadata`: one line, or empty.
    void open(const std::string& head, const std::string& metadata = "") {
        if (metadata.empty()) {
            line(head);
        } else {
            line(head + " (");
            ++depth_;
            line(metadata);
            --depth_;
            line(")");
        }
        line("{");
        ++depth_;
    }

    void close(std::size_t prims = 1) {
        for (; prims > 0; --prims) {
            --depth_;
            line("}");
        }
    }

    void line(const std::string& content) { text_ += std::string(4 * depth_, ' ') + content + '\n'; }
    const std::string& text() const { return text_; }

private:
    std::string text_;
    std::size_t depth_ = 0;
};

void write_sphere(LayerWriter& layer, std::size_t index, const Sphere& s) {
    const std::string r = number_text(s.radius);
    layer.open("def Sphere \"s" + std::to_string(index) + '"', "prepend apiSchemas = [\"PhysicsCollisionAPI\"]");
    layer.line("double radius = " + r);
    layer.line(fmt::format("float3[] extent = [(-{0}, -{0}, -{0}), ({0}, {0}, {0})]", r));
    layer.line("uniform token purpose = \"guide\"");
    layer.line(fmt::format("double3 xformOp:translate = ({}, {}, {})", number_text(s.center.x), number_text(s.center.y),
                           number_text(s.center.z)));
    layer.line("uniform token[] xformOpOrder = [\"xformOp:translate\"]");
    layer.close();
}

std::string tuple(const Vec3& v) {
    return fmt::format("({}, {}, {})", number_text(v.x), number_text(v.y), number_text(v.z));
}

/// Writes what all elements have: their extent, place and, unless it is none, rotation and scale.
void write_place(LayerWriter& layer, const Vec3& half_extent, const Pose& pose, const Vec3& scale) {
    layer.line(fmt::format("float3[] extent = [{}, {}]", tuple(half_extent * -1.0), tuple(half_extent)));
    layer.line("uniform token purpose = \"guide\"");
    layer.line("double3 xformOp:translate = " + tuple(pose.translation));
    std::string order = "\"xformOp:translate\"";
    if (pose.rotation != Pose{}.rotation) {
        const auto [w, x, y, z] = quaternion(pose); // a quaternion of USD begins with its real part
        layer.line(fmt::format("quatd xformOp:orient = ({}, {}, {}, {})", number_text(w), number_text(x),
                               number_text(y), number_text(z)));
        order += ", \"xformOp:orient\"";
    }
    if (scale != Vec3{1, 1, 1}) {
        layer.line("double3 xformOp:scale = " + tuple(scale));
        order += ", \"xformOp:scale\"";
    }
    layer.line("uniform token[] xformOpOrder = [" + order + "]");
}

void write_hull(LayerWriter& layer, const Element& hull) {
    std::string counts, indices, points;
    Vec3 extent;
    for (const Vec3& p : hull.hull->surface.vertices) {
        points += (points.empty() ? "" : ", ") + tuple(p);
        extent = {std::max(extent.x, std::abs(p.x)), std::max(extent.y, std::abs(p.y)),
                  std::max(extent.z, std::abs(p.z))};
    }
    for (const auto& [a, b, c] : hull.hull->surface.triangles) {
        counts += counts.empty() ? "3" : ", 3";
        indices += fmt::format("{}{}, {}, {}", indices.empty() ? "" : ", ", a, b, c);
    }
    layer.line("int[] faceVertexCounts = [" + counts + "]");
    layer.line("int[] faceVertexIndices = [" + indices + "]");
    layer.line("point3f[] points = [" + points + "]");
    layer.line("uniform token subdivisionScheme = \"none\"");
    layer.line("uniform token physics:approximation = \"convexHull\"");
    write_place(layer, extent, hull.pose, {1, 1, 1});
}

/// Writes an element of a kind that USD knows and that is no sphere.
void write_element(LayerWriter& layer, std::size_t index, const Element& element) {
    using Kind = Element::Kind;
    const char* type = element.kind == Kind::capsule    ? "Capsule"
                       : element.kind == Kind::cylinder ? "Cylinder"
                       : element.kind == Kind::box      ? "Cube"
                                                        : "Mesh";
    layer.open(fmt::format("def {} \"{}{}\"", type, to_string(element.kind), index),
               element.kind == Kind::hull
                   ? "prepend apiSchemas = [\"PhysicsCollisionAPI\", \"PhysicsMeshCollisionAPI\"]"
                   : "prepend apiSchemas = [\"PhysicsCollisionAPI\"]");
    if (element.kind == Kind::hull) {
        write_hull(layer, element);
        layer.close();
        return;
    }
    const Element stated = stated_at(element, from_quaternion(element.pose.translation, quaternion(element.pose)));
    if (element.kind == Kind::box) {
        layer.line("double size = 2");
        write_place(layer, {1, 1, 1}, element.pose, stated.half); // the extent is before the scale
    } else {
        const double caps = element.kind == Kind::capsule ? stated.radius : 0; // the height is without them
        layer.line("uniform token axis = \"Z\"");
        layer.line("double height = " + number_text(2 * stated.half.z));
        layer.line("double radius = " + number_text(stated.radius));
        write_place(layer, {stated.radius, stated.radius, stated.half.z + caps}, element.pose, {1, 1, 1});
    }
    layer.close();
}

void write_spheres(LayerWriter& layer, const LinkSpheres& link) {
    layer.open("def Scope \"foam_spheres\"");
    layer.line("custom string foam:link = " + literal(link.link)); // the prim's name may differ
    CancellationCounter asking(1024);
    std::size_t i = 0;
    for (const Sphere& sphere : link.elements.spheres()) {
        asking.check();
        write_sphere(layer, i++, sphere);
    }
    for (const Element& element : link.elements.shaped()) {
        asking.check();
        write_element(layer, i++, element);
    }
    layer.close();
}

std::string header(const SphereModel& model, const LayerOptions& options) {
    std::string text = "#usda 1.0\n";
    text += model.provenance.empty() ? "" : "# " + shown(model.provenance) + "\n";
    text += "(\n";
    text += options.sublayer.empty() ? "" : "    subLayers = [@" + options.sublayer + "@]\n";
    return text + "    metersPerUnit = 1\n    upAxis = \"Z\"\n)\n\n";
}

void require_options(const LayerOptions& options) {
    if (options.sublayer.find('@') != options.sublayer.npos || shown(options.sublayer) != options.sublayer) {
        throw Error(ErrorCode::output, fmt::format("write.usd: sublayer: '{}' has characters that no reference holds; "
                                                   "remedy: a path without '@' and control characters",
                                                   shown(options.sublayer)));
    }
    if (!options.inactive.empty() && !is_identifier(options.inactive)) {
        throw Error(ErrorCode::output,
                    fmt::format("write.usd: inactive: '{}' is no name of a prim; remedy: letters, digits and '_', such "
                                "as collisions",
                                shown(options.inactive)));
    }
}

/// Returns the links of the robot, and those with spheres.
std::vector<std::string> all_links(const SphereModel& model, const std::vector<LinkSpheres>& links) {
    std::vector<std::string> names;
    for (const LinkSpheres& link : links) {
        names.push_back(link.link);
    }
    if (model.robot) {
        for (const Link& link : model.robot->links) {
            names.push_back(link.name);
        }
    }
    return names;
}

/// Returns the paths of the links that need no check against each link, for the first link of each pair.
std::map<std::string, std::string> filtered_paths(const SphereModel& model, const std::vector<LinkSpheres>& links,
                                                  const std::map<std::string, std::string>& names,
                                                  const PathPattern& pattern) {
    std::map<std::string, std::string> paths;
    const auto has_spheres = [&](const std::string& name) {
        return std::any_of(links.begin(), links.end(), [&](const LinkSpheres& link) { return link.link == name; });
    };
    for (const IgnoredPair& pair : model.ignored_pairs.value_or(std::vector<IgnoredPair>{})) {
        if (has_spheres(pair.first) && has_spheres(pair.second)) {
            std::string& list = paths[pair.first];
            list += (list.empty() ? "<" : ", <") + pattern.path(names.at(pair.second)) + ">";
        }
    }
    return paths;
}

/// Writes the prims of a link. `filtered`: paths of the links that it is not checked against.
void write_link(LayerWriter& layer, const LinkSpheres& link, const std::vector<std::string>& parts,
                const std::string& filtered, const LayerOptions& options) {
    for (const std::string& part : parts) {
        const bool filters = &part == &parts.back() && !filtered.empty();
        layer.open("over \"" + part + '"', filters ? "prepend apiSchemas = [\"PhysicsFilteredPairsAPI\"]" : "");
    }
    if (!filtered.empty()) {
        layer.line("rel physics:filteredPairs = [" + filtered + "]");
    }
    if (!options.inactive.empty()) {
        layer.open("over \"" + options.inactive + '"', "active = false");
        layer.close();
    }
    write_spheres(layer, link);
    layer.close(parts.size());
}

} // namespace

std::string layer_text(const SphereModel& model, const LayerOptions& options) {
    require_options(options);
    const std::vector<LinkSpheres> links = in_known_kinds(elements_by_link(model), options.known);
    const std::map<std::string, std::string> names = prim_names(all_links(model, links));
    const std::string robot = model.robot && !model.robot->name.empty() ? model.robot->name : model.name;
    const PathPattern pattern(options.prim, robot, links.size() > 1);
    const auto filtered =
        options.pairs ? filtered_paths(model, links, names, pattern) : std::map<std::string, std::string>{};
    LayerWriter layer;
    for (const std::string& part : pattern.above()) {
        layer.open("over \"" + part + '"');
    }
    for (const LinkSpheres& link : links) {
        const auto paths = filtered.find(link.link);
        write_link(layer, link, pattern.below(names.at(link.link)), paths == filtered.end() ? "" : paths->second,
                   options);
    }
    layer.close(pattern.above().size());
    return header(model, options) + layer.text();
}

} // namespace foam::usd
