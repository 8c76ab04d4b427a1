// COLLADA 1.4.1 and 1.5: the geometries that the nodes of the scene show, in metres.
//
// RViz and the planners of ROS do not turn COLLADA coordinates: the unit is applied, the up-axis is not.
#include "collada.hpp"
#include "readers.hpp"

#include <fmt/format.h>

#include <map>

namespace foam::load_mesh {
namespace {

using xml::Element;

constexpr std::size_t deepest = 200;        ///< depth of nested nodes, including instances
constexpr std::size_t most_nodes = 1000000; ///< a few nested instances can stand for too many nodes

class SceneReader {
public:
    SceneReader(const Source& source, MeshBuilder& builder, Context& context)
        : document_(source), builder_(builder), context_(context) {}

    void read() {
        const Affine unit = Affine::scaling(Vec3{1, 1, 1} * metres_per_unit());
        if (const Element* scene = visual_scene()) {
            nodes(*scene, unit);
        } else {
            all_geometries(unit);
        }
        tell_up_axis();
        if (skinned_) {
            context_.log(Severity::info, fmt::format("{}: it has skinned or morphed parts, which are taken as they are "
                                                     "without their bones and targets",
                                                     document_.source().file.string()));
        }
    }

private:
    struct Visit {
        const Element* node;
        Affine pose;
        std::size_t depth;
    };

    double metres_per_unit() const {
        const Element* asset = document_.root().child("asset");
        const Element* unit = asset ? asset->child("unit") : nullptr;
        const std::string* text = unit ? unit->attribute("meter") : nullptr;
        if (!text) {
            return 1;
        }
        const auto value = to_number(*text);
        if (!value || !(*value > 0) || !std::isfinite(*value)) {
            throw document_.error(*unit, fmt::format("the unit is to be a positive number of metres, got {}; remedy: "
                                                     "write its size, e.g. meter=\"0.001\" for millimetres",
                                                     printable(*text)));
        }
        return *value;
    }

    void tell_up_axis() {
        const Element* asset = document_.root().child("asset");
        const Element* up = asset ? asset->child("up_axis") : nullptr;
        const std::string axis(up ? ElementWords(document_.source(), *up).next() : "");
        if (!axis.empty() && axis != "Z_UP") {
            context_.log(Severity::info, fmt::format("{}: its up-axis {} is ignored, as RViz and MoveIt do",
                                                     document_.source().file.string(), printable(axis)));
        }
    }

    /// Returns the scene that <scene> names, or else the first.
    const Element* visual_scene() const {
        const Element* scene = document_.root().child("scene");
        const Element* instance = scene ? scene->child("instance_visual_scene") : nullptr;
        const Element* target = instance ? document_.target(*instance, "url") : nullptr;
        if (target) {
            return target;
        }
        const Element* library = document_.root().child("library_visual_scenes");
        return library ? library->child("visual_scene") : nullptr;
    }

    void all_geometries(const Affine& unit) {
        for (const Element* library : document_.root().children_named("library_geometries")) {
            for (const Element* geometry : library->children_named("geometry")) {
                place(part(*geometry).part, unit, builder_);
            }
        }
    }

    void nodes(const Element& scene, const Affine& unit) {
        std::vector<Visit> open{{&scene, unit, 0}};
        std::size_t visited = 0;
        while (!open.empty()) {
            const Visit visit = open.back();
            open.pop_back();
            if (visit.depth > deepest || ++visited > most_nodes) {
                throw document_.error(
                    *visit.node, fmt::format("nodes lie more than {} deep or are shown more than {} times; remedy: "
                                             "export the mesh again without instances of instances",
                                             deepest, most_nodes));
            }
            const std::size_t first = open.size();
            for (const auto& child : visit.node->children) {
                if (child->name == "node") {
                    open.push_back({child.get(), visit.pose * transform_of(document_, *child), visit.depth + 1});
                } else if (const Element* node = instanced(*child, "instance_node", "node")) {
                    open.push_back({node, visit.pose * transform_of(document_, *node), visit.depth + 1});
                } else if (const Element* shown = shown_geometry(*child)) {
                    const ColladaGeometry& geometry = part(*shown);
                    place(geometry.part, visit.pose, builder_, colours_of(document_, *child, geometry.materials));
                }
            }
            std::reverse(open.begin() + static_cast<std::ptrdiff_t>(first), open.end()); // the first child is next
        }
    }

    /// Returns the target of `instance` if it is an element of that name; nullptr, with a warning, if it is not in the
    /// file.
    const Element* instanced(const Element& instance, std::string_view name, std::string_view target_name) const {
        if (instance.name != name) {
            return nullptr;
        }
        const Element* target = document_.target(instance, "url");
        if (target && target->name == target_name) {
            return target;
        }
        const std::string* url = instance.attribute("url");
        context_.log(Severity::warning,
                     document_
                         .error(instance, fmt::format("<{}> shows {}, which this file does not hold; it is left out",
                                                      name, url ? printable(*url) : "nothing"))
                         .what());
        return nullptr;
    }

    const Element* shown_geometry(const Element& instance) {
        const Element* target = instanced(instance, "instance_geometry", "geometry");
        if (!target) {
            target = instanced(instance, "instance_controller", "controller");
        }
        for (std::size_t depth = 0; target && target->name == "controller" && depth < deepest; ++depth) {
            skinned_ = true;
            const Element* kind = target->child("skin");
            kind = kind ? kind : target->child("morph");
            target = kind ? document_.target(*kind, "source") : nullptr;
        }
        return target && target->name == "geometry" ? target : nullptr;
    }

    const ColladaGeometry& part(const Element& geometry) {
        const auto [it, fresh] = parts_.try_emplace(&geometry);
        if (fresh) {
            it->second = read_geometry(document_, geometry, context_);
        }
        return it->second;
    }

    const ColladaDocument document_;
    MeshBuilder& builder_;
    Context& context_;
    std::map<const Element*, ColladaGeometry> parts_;
    bool skinned_ = false;
};

} // namespace

void read_collada(const Source& source, MeshBuilder& builder, Context& context) {
    SceneReader(source, builder, context).read();
}

} // namespace foam::load_mesh
