#include <foam/base/error.hpp>
#include <foam/base/text.hpp>
#include <foam/sdk/engines.hpp>
#include <foam/sdk/kinds.hpp>
#include <foam/sdk/model.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace foam::inline sdk {
namespace {

using Kind = Element::Kind;

/// Bullet's shapes of a URDF: bullet3, examples/Importers/ImportURDFDemo/BulletUrdfImporter.cpp.
namespace bullet {

/// gUrdfDefaultCollisionMargin, m: a core that is smaller by it, and round by it.
constexpr double margin = 1e-3;
constexpr double rounding = 1e-9; ///< m, of the proof
/// What a corner of three faces, or an edge of two, has to grow so that it lies in the round one.
const double of_corner = margin * (1 - 1 / std::numbers::sqrt3) + rounding;
const double of_edge = margin * (1 - 1 / std::numbers::sqrt2) + rounding;
/// Without URDF_USE_IMPLICIT_CYLINDER a cylinder is a prism of 32 sides in it, widened by the margin.
const double prism = std::cos(std::numbers::pi / 32);

Element stated(Element element) {
    if (element.kind == Kind::box) {
        for (int axis = 0; axis < 3; ++axis) {
            element.half[axis] = std::max(element.half[axis] + of_corner, margin);
        }
    } else if (element.kind == Kind::cylinder) {
        element.half.z = std::max(element.half.z + of_edge, margin);
        element.radius = std::max({element.radius + of_edge, (element.radius - margin) / prism + rounding, margin});
    }
    return element;
}

Element held(Element element) {
    if (element.kind == Kind::box) {
        element.kind = Kind::swept_box;
        element.half = element.half - Vec3{margin, margin, margin};
        element.radius = margin;
    } else if (element.kind == Kind::cylinder) {
        element.half.z -= of_edge - rounding;
        element.radius = std::min(element.radius - of_edge + rounding, element.radius * prism + margin);
    }
    return element;
}

} // namespace bullet

/// PhysX in SAPIEN: cylinders are prisms of 32 sides, made as convex meshes. Those lack corners that are nearer to the
/// others' hull than PxCookingParams::planeTolerance, 0.7 mm, or 0.07 % of a size above 1 m (PhysX 5, PxCooking.h).
namespace physx {

constexpr double tolerance = 0.75e-3; ///< m, or of the size, if that is larger than 1 m
const double prism = std::cos(std::numbers::pi / 32);

double lost_of(const Element& element) {
    return tolerance * std::max(1.0, 2 * (element.half.z + element.radius));
}

Element stated(Element element) {
    if (element.kind == Kind::cylinder) {
        const double more = 1.01 * lost_of(element); // the size grows, too
        element.half.z += more;
        element.radius = (element.radius + more) / prism;
    }
    return element;
}

Element held(Element element) {
    if (element.kind == Kind::cylinder) {
        const double less = lost_of(element);
        element.half.z = std::max(element.half.z - less, 0.0);
        element.radius = std::max(element.radius * prism - less, 0.0);
    }
    return element;
}

} // namespace physx

/// VAMP places spheres in single precision: their centres were up to 5.4 µm off (tests/python/consumers/weekly).
namespace vamp {

constexpr double off = 1e-5, rounding = 1e-12; ///< m

Element stated(Element element) {
    element.radius += off + rounding;
    return element;
}

Element held(Element element) {
    element.radius -= off;
    return element;
}

} // namespace vamp

/// Costs by kind: sphere, capsule, cylinder, box, swept box (a hull of 48 vertices), hull, ellipsoid (not measured).
/// docs/benchmarks/element_checks.md.
constexpr ElementCost of_coal{.of_kind = {1, 1.5, 4.5, 3, 8.5, 4.5, 8}, .of_hull_vertex = 0};
constexpr ElementCost of_mujoco{.of_kind = {1, 1, 2, 1.5, 5, 4, 8}, .of_hull_vertex = 0};
constexpr ElementCost of_bullet{.of_kind = {1, 1, 2, 1, 6, 4, 8}, .of_hull_vertex = 0};

const Engine table[] = {
    {.name = "coal",
     .title = "Pinocchio 4.1.0 with coal 3.0.3",
     .writers = {"write.urdf"},
     .kinds = every_kind(),
     .cost = of_coal,
     .advice = "Hulls are meshes in files beside the URDF: pass its folder as package_dirs, and make them convex by "
               "buildConvexHull(), or coal takes them for surfaces that are hollow."},
    {.name = "curobo", .title = "cuRobo 0.8", .writers = {"write.curobo", "write.xrdf"}, .kinds = {Kind::sphere}},
    {.name = "drake", .title = "Drake 1.51.1", .writers = {"write.urdf", "write.sdf"}, .kinds = every_kind()},
    {.name = "mjx",
     .title = "MuJoCo MJX 3.17.0",
     .writers = {"write.mjcf"},
     .kinds = {Kind::sphere, Kind::capsule, Kind::box, Kind::hull},
     .most_hull_vertices = 20,
     .cost = of_mujoco,
     .advice = "It has no checks of cylinders and ellipsoids against boxes and hulls. A step with hulls takes minutes "
               "to compile."},
    {.name = "mujoco",
     .title = "MuJoCo 4.0.0, MuJoCo Warp 4.0.0",
     .writers = {"write.mjcf"},
     .kinds = every_kind(),
     .cost = of_mujoco},
    {.name = "newton",
     .title = "Newton 1.8.0",
     .writers = {"write.usd", "write.mjcf", "write.urdf"},
     .kinds = every_kind(),
     .advice = "Of a URDF it reads no pairs of links. Hulls of URDF and MJCF are concave meshes in it; those of USD "
               "stay convex."},
    {.name = "physx",
     .title = "PhysX 5 in SAPIEN 3.0.3",
     .writers = {"write.urdf", "write.usd"},
     .kinds = {Kind::sphere, Kind::capsule, Kind::cylinder, Kind::box},
     .stated = physx::stated,
     .held = physx::held,
     .loss = "It makes prisms of 32 sides of cylinders, and drops corners of them. So cylinders are 0.8 mm (0.08 % of "
             "a length above 1 m) and 0.5 % of their radius larger. It misses some contacts of hulls, more than a "
             "millimetre deep, also of larger hulls. So foam refuses hulls.",
     .advice = "Switch off enable_pcm of the scene: with it PhysX misses deep contacts of bodies that were moved."},
    {.name = "pybullet",
     .title = "PyBullet 3.2.7",
     .writers = {"write.urdf"},
     .kinds = every_kind(),
     .stated = bullet::stated,
     .held = bullet::held,
     .cost = of_bullet,
     .loss = "It rounds edges and corners of boxes and cylinders by 1 mm, and makes prisms of 32 sides of cylinders. "
             "So boxes are 0.43 mm larger on each side, cylinders 0.3 mm, or up to 0.5 % of their radius, and both at "
             "least 2 mm thick. Hulls hold 1 mm more than the file says."},
    {.name = "vamp",
     .title = "VAMP 0.6.4",
     .writers = {"write.vamp"},
     .kinds = {Kind::sphere},
     .stated = vamp::stated,
     .held = vamp::held,
     .loss = "It places spheres in single precision, up to 5.4 µm off. So they are 0.01 mm larger."},
};

const Engine* find(std::string_view name) {
    const auto found = std::find_if(std::begin(table), std::end(table),
                                    [&](const Engine& engine) { return engine.name == name; });
    return found == std::end(table) ? nullptr : found;
}

/// Throws Error(output) for an element that does not collide in the engine.
void require_collides(const Engine& engine, const Element& element, const std::string& link) {
    if (!knows_all(engine.kinds, {element.kind})) {
        throw Error(ErrorCode::output,
                    fmt::format("link '{}': foam writes no {} for {}; remedy: {}", shown(link),
                                noun_of(element.kind, 2), engine.title, words_of(engine.kinds)));
    }
    const std::size_t vertices = element.hull ? element.hull->surface.vertices.size() : 0;
    if (engine.most_hull_vertices > 0 && vertices > engine.most_hull_vertices) {
        throw Error(ErrorCode::output,
                    fmt::format("link '{}': a hull of {} vertices, {} takes at most {}; remedy: approximate.hulls with "
                                "max_vertices: {}, or other kinds",
                                shown(link), vertices, engine.title, engine.most_hull_vertices,
                                engine.most_hull_vertices));
    }
}

/// Returns the elements, each changed by the function.
template <class Change> Elements changed(const Elements& elements, const Change& change) {
    Elements result;
    for (const Sphere& sphere : elements.spheres()) {
        result.add(change(Element{.pose = {.translation = sphere.center}, .radius = sphere.radius}));
    }
    for (const Element& element : elements.shaped()) {
        result.add(change(element));
    }
    return result;
}

} // namespace

std::span<const Engine> engines() {
    return table;
}

const Engine& engine_named(std::string_view name) {
    if (const Engine* engine = find(name)) {
        return *engine;
    }
    std::vector<std::string> names;
    for (const Engine& engine : table) {
        names.emplace_back(engine.name);
    }
    const std::string near = nearest_word(std::string(name), names);
    throw Error(ErrorCode::usage,
                fmt::format("no engine '{}'{}; there are: {}", shown(std::string(name)),
                            near.empty() ? "" : fmt::format("; did you mean '{}'?", near), fmt::join(names, ", ")));
}

Parameter engine_parameter(std::string_view writer) {
    std::vector<std::string> names{"any"};
    for (const Engine& engine : table) {
        if (std::find(engine.writers.begin(), engine.writers.end(), writer) != engine.writers.end()) {
            names.emplace_back(engine.name);
        }
    }
    return Parameter::choice("engine", names, "any")
        .doc("The program that the file is for: spellings as it reads them, and shapes so much larger that what it "
             "collides with contains the model's elements. `foam formats --for` says what each needs.");
}

const Engine* engine_of(const Parameters& parameters) {
    return find(parameters.text("engine"));
}

std::vector<LinkSpheres> stated_for(const Engine* engine, std::vector<LinkSpheres> links) {
    for (LinkSpheres& link : links) {
        if (engine) {
            link.elements = changed(link.elements, [&](const Element& element) {
                require_collides(*engine, element, link.link);
                return engine->stated ? engine->stated(element) : element;
            });
        }
    }
    return links;
}

std::map<std::string, Elements> held_by(const Engine* engine, std::map<std::string, Elements> links) {
    if (engine && engine->held) {
        for (auto& [name, elements] : links) {
            elements = changed(elements, engine->held);
        }
    }
    return links;
}

} // namespace foam::inline sdk
