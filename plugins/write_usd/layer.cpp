#include "layer.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/base/error.hpp>
#include <foam/base/text.hpp>
#include <foam/geometry/element_forms.hpp>
#include <foam/geometry/vector.hpp>
#include <foam/sdk/writing.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>

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
    /// Begins a prim. `metadata`: lines of it.
    void open(const std::string& head, const std::vector<std::string>& metadata = {}) {
        if (metadata.empty()) {
            line(head);
        } else {
            line(head + " (");
            ++depth_;
            for (const std::string& one : metadata) {
                line(one);
            }
            --depth_;
            line(")");
        }
        line("{");
        ++depth_;
    }

    void close() {
        --depth_;
        line("}");
    }

    void line(const std::string& content) { text_ += std::string(4 * depth_, ' ') + content + '\n'; }
    const std::string& text() const { return text_; }

private:
    std::string text_;
    std::size_t depth_ = 0;
};

void write_sphere(LayerWriter& layer, std::size_t index, const Sphere& s) {
    const std::string r = number_text(s.radius);
    layer.open("def Sphere \"s" + std::to_string(index) + '"', {"prepend apiSchemas = [\"PhysicsCollisionAPI\"]"});
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
               {element.kind == Kind::hull
                    ? "prepend apiSchemas = [\"PhysicsCollisionAPI\", \"PhysicsMeshCollisionAPI\"]"
                    : "prepend apiSchemas = [\"PhysicsCollisionAPI\"]"});
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

/// A prim of the robot that the layer lies over.
struct Over {
    explicit Over(std::string its_name) : name(std::move(its_name)) {}

    /// Returns the prim of a path below this one.
    Over& at(const std::vector<std::string>& parts) {
        Over* over = this;
        for (const std::string& part : parts) {
            auto found = std::ranges::find(over->children, part, [](const auto& child) { return child->name; });
            if (found == over->children.end()) {
                found = over->children.insert(found, std::make_unique<Over>(part));
            }
            over = found->get();
        }
        return *over;
    }

    std::string name;
    std::vector<std::string> metadata{}, properties{};
    std::vector<std::unique_ptr<Over>> children{};
    const LinkSpheres* link = nullptr;         ///< whose elements it gets; null: none
    const StageOfRobot::Place* place = nullptr; ///< of the link in its stage; null: unknown
};

/// Returns the line of a transform of USD, for row vectors.
std::string transform_text(const std::array<double, 16>& matrix) {
    std::string rows;
    for (std::size_t row = 0; row < 4; ++row) {
        rows += fmt::format("{}({}, {}, {}, {})", row == 0 ? "" : ", ", number_text(matrix[4 * row]),
                            number_text(matrix[4 * row + 1]), number_text(matrix[4 * row + 2]),
                            number_text(matrix[4 * row + 3]));
    }
    return "matrix4d xformOp:transform = ( " + rows + " )";
}

void write_elements(LayerWriter& layer, const LinkSpheres& link, const StageOfRobot::Place* place) {
    const bool moved = place && place->from_metres != StageOfRobot::Place{}.from_metres;
    layer.open(moved ? "def Xform \"foam_spheres\"" : "def Scope \"foam_spheres\"");
    layer.line("custom string foam:link = " + literal(link.link)); // the prim's name may differ
    if (moved) {
        layer.line(transform_text(place->from_metres));
        layer.line("uniform token[] xformOpOrder = [\"xformOp:transform\"]");
    }
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

void write(LayerWriter& layer, const Over& over) {
    layer.open("over \"" + over.name + '"', over.metadata);
    for (const std::string& property : over.properties) {
        layer.line(property);
    }
    for (const auto& child : over.children) {
        write(layer, *child);
    }
    if (over.link) {
        write_elements(layer, *over.link, over.place);
    }
    layer.close();
}

std::vector<std::string> parts_of(std::string_view path) {
    std::vector<std::string> parts;
    for (std::size_t begin = 1; begin < path.size();) {
        const std::size_t end = std::min(path.find('/', begin), path.size());
        parts.emplace_back(path.substr(begin, end - begin));
        begin = end + 1;
    }
    return parts;
}

/// Returns the stage that the robot was read from, if the layer goes over it.
const StageOfRobot* stage_below(const SphereModel& model, const LayerOptions& options) {
    return model.robot && options.prim == usual_prim ? model.robot->stage.get() : nullptr;
}

/// Returns the path of the robot's file, from the folder of the output.
std::string path_below(const SphereModel& model) {
    if (model.folder.empty()) {
        return "./" + model.robot->file.filename().string();
    }
    const std::string seen = path_seen_from(model.folder, model.robot->file);
    return (seen.starts_with("..") ? "" : "./") + seen;
}

std::string header(const SphereModel& model, const LayerOptions& options) {
    std::string text = "#usda 1.0\n";
    text += model.provenance.empty() ? "" : "# " + shown(model.provenance) + "\n";
    text += "(\n";
    const StageOfRobot* stage = stage_below(model, options);
    text += stage && !stage->default_prim.empty() ? "    defaultPrim = " + literal(stage->default_prim) + "\n" : "";
    const std::string below = !options.sublayer.empty() ? options.sublayer : stage ? path_below(model) : "";
    text += below.empty() ? "" : "    subLayers = [@" + below + "@]\n";
    return text + fmt::format("    metersPerUnit = {}\n    upAxis = \"{}\"\n)\n\n",
                              number_text(stage ? stage->metres_per_unit : 1), stage ? stage->up_axis : "Z");
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

/// Returns the path of the prim of each link.
std::map<std::string, std::string> paths_of(const SphereModel& model, const LayerOptions& options,
                                            const std::vector<LinkSpheres>& links) {
    std::map<std::string, std::string> paths;
    if (const StageOfRobot* stage = stage_below(model, options)) {
        for (const auto& [link, place] : stage->links) {
            paths[link] = place.path;
        }
        return paths;
    }
    const std::string robot = model.robot && !model.robot->name.empty() ? model.robot->name : model.name;
    const PathPattern pattern(options.prim, robot, links.size() > 1);
    for (const auto& [link, name] : prim_names(all_links(model, links))) {
        paths[link] = pattern.path(name);
    }
    return paths;
}

/// Adds the links that need no check against each link, to the first of each pair.
void add_pairs(Over& root, const SphereModel& model, const std::vector<LinkSpheres>& links,
               const std::map<std::string, std::string>& paths) {
    std::map<std::string, std::string> lists;
    const auto has_elements = [&](const std::string& name) {
        return std::any_of(links.begin(), links.end(), [&](const LinkSpheres& link) { return link.link == name; });
    };
    for (const IgnoredPair& pair : model.ignored_pairs.value_or(std::vector<IgnoredPair>{})) {
        if (has_elements(pair.first) && has_elements(pair.second)) {
            std::string& list = lists[pair.first];
            list += (list.empty() ? "<" : ", <") + paths.at(pair.second) + ">";
        }
    }
    for (const auto& [link, list] : lists) {
        Over& over = root.at(parts_of(paths.at(link)));
        over.metadata.push_back("prepend apiSchemas = [\"PhysicsFilteredPairsAPI\"]");
        over.properties.push_back("rel physics:filteredPairs = [" + list + "]");
    }
}

/// Switches the colliders of links off that have elements, or are to have none.
void switch_off(Over& root, const SphereModel& model, const StageOfRobot& stage, const std::vector<LinkSpheres>& links) {
    std::vector<std::string> names = model.without_collision;
    for (const LinkSpheres& link : links) {
        names.push_back(link.link);
    }
    std::vector<std::string> off;
    for (const std::string& name : names) {
        if (const auto place = stage.links.find(name); place != stage.links.end()) {
            off.insert(off.end(), place->second.colliders.begin(), place->second.colliders.end());
        }
    }
    for (const std::string& instance : stage.instances) { // what is below one cannot be changed
        if (std::ranges::any_of(off, [&](const std::string& path) { return path.starts_with(instance + "/"); })) {
            root.at(parts_of(instance)).metadata.push_back("instanceable = false");
        }
    }
    for (const std::string& path : off) {
        std::vector<std::string>& properties = root.at(parts_of(path)).properties;
        constexpr const char* line = "bool physics:collisionEnabled = 0";
        if (std::ranges::find(properties, line) == properties.end()) {
            properties.push_back(line);
        }
    }
}

} // namespace

std::string layer_text(const SphereModel& model, const LayerOptions& options) {
    require_options(options);
    const std::vector<LinkSpheres> links = in_known_kinds(elements_by_link(model), options.known);
    const std::map<std::string, std::string> paths = paths_of(model, options, links);
    const StageOfRobot* stage = stage_below(model, options);
    Over root("");
    for (const LinkSpheres& link : links) {
        if (!paths.contains(link.link)) {
            throw Error(ErrorCode::output, fmt::format("write.usd: the stage has no prim for the link '{}'; remedy: a "
                                                       "defaultPrim in the stage, or skip the link",
                                                       shown(link.link)));
        }
        Over& over = root.at(parts_of(paths.at(link.link)));
        over.link = &link;
        over.place = stage ? &stage->links.at(link.link) : nullptr;
        if (!options.inactive.empty()) {
            over.at({options.inactive}).metadata = {"active = false"};
        }
    }
    if (options.pairs) {
        add_pairs(root, model, links, paths);
    }
    if (stage) {
        switch_off(root, model, *stage, links);
    }
    LayerWriter layer;
    for (const auto& over : root.children) {
        write(layer, *over);
    }
    return header(model, options) + layer.text();
}

} // namespace foam::usd
