// The spheres of each link, from the files that contain them.
#include "evaluate/original.hpp"

#include <foam/base/error.hpp>
#include <foam/base/parallel.hpp>
#include <foam/geometry/measure.hpp>
#include <foam/judge/collision_model.hpp>
#include <foam/recipe/robot_choices.hpp>
#include <foam/robot/held_joints.hpp>
#include <foam/sdk/context.hpp>
#include <foam/sdk/stage.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace foam::inline judge {
namespace {

/// Takes the spheres of a link without other geometry. Returns false if it has other geometry.
bool take_spheres(const Link& link, Elements& elements) {
    for (const GeometryElement& element : link.collisions) {
        const auto* primitive = std::get_if<Element>(&element.geometry);
        if (!primitive || primitive->kind != Element::Kind::sphere) {
            elements = {};
            return false;
        }
        elements.add(Sphere{element.origin.translation, primitive->radius});
    }
    return true;
}

std::size_t index_of(const Robot& robot, const std::string& link) {
    return static_cast<std::size_t>(robot.find_link(link) - robot.links.data());
}

void take_solids(const Original& original, CollisionModel& model) {
    model.solids.resize(model.robot->links.size());
    for (const OriginalLink& link : original.links) {
        model.solids[index_of(*model.robot, link.link)] = link.solid;
    }
}

void require_pairs(const CollisionModel& model) {
    std::size_t with_spheres = 0;
    for (std::size_t i = 0; i < model.elements.size(); ++i) {
        with_spheres += model.elements[i].empty() ? 0 : 1;
    }
    if (with_spheres < 2) {
        throw Error(ErrorCode::input, fmt::format("{}: {} {} collision geometry: there is no pair of links to check",
                                                  model.robot->file.string(), with_spheres == 0 ? "no" : "only one",
                                                  with_spheres == 0 ? "link has" : "link has"));
    }
}

} // namespace

void refuse_mesh(const LoadedInput& loaded) {
    if (loaded.report.stage.empty()) {
        throw Error(ErrorCode::input, fmt::format("{}: a mesh has no joints; remedy: give a URDF", loaded.chosen));
    }
}

/// Takes the spheres of links that have nothing else. Returns whether a link that is chosen has geometry.
static bool take_own_spheres(const RobotChoices& choices, CollisionModel& model) {
    bool any = false;
    for (std::size_t i = 0; i < model.elements.size(); ++i) {
        const Link& link = model.robot->links[i];
        if (link.collisions.empty() || !is_chosen(choices, link.name)) {
            continue;
        }
        any = true;
        if (take_spheres(link, model.elements[i])) {
            model.sources[i] = CollisionModel::Source::geometry;
        }
    }
    return any;
}

CollisionModel collision_model_of(const std::shared_ptr<const LoadedInput>& loaded, const Registry& registry,
                                  std::size_t spheres_per_link, const OriginalOptions& options) {
    refuse_mesh(*loaded);
    const RobotChoices choices{.keep = options.links, .skip = options.skip, .locks = options.held};
    require_choices(choices, *loaded->robot);
    CollisionModel model;
    model.robot = std::make_shared<const Robot>(
        with_joints_held(with_covered_geometry(*loaded->robot, options.geometry), options.held));
    model.elements.resize(model.robot->links.size());
    model.sources.resize(model.robot->links.size(), CollisionModel::Source::none);
    if (take_own_spheres(choices, model)) {
        const Original original = original_of(loaded, registry, options);
        model.notes = original.notes;
        take_solids(original, model);
        const auto spherizer = registry.make<Spherizer>("spherize.cover", {{"effort", "fast"}});
        for (const OriginalLink& link : original.links) {
            const std::size_t i = index_of(*model.robot, link.link);
            if (model.sources[i] == CollisionModel::Source::geometry) {
                continue;
            }
            QuietContext context;
            const Shape shape(link.link, link.solid, link.solid);
            model.elements[i] = spherizer->spherize(shape, {spheres_per_link, {}, Guarantee::outer}, context).finest();
            model.sources[i] = CollisionModel::Source::cover;
        }
    }
    require_pairs(model);
    return model;
}

CollisionModel load_collision_model(const std::filesystem::path& urdf, const Registry& registry,
                                    std::size_t spheres_per_link, const OriginalOptions& options) {
    OriginalOptions named = options;
    named.name = options.name.empty() ? urdf : options.name; // messages have the file as it is given
    return collision_model_of(read_original(urdf, registry, named), registry, spheres_per_link, named);
}

CollisionModel collision_model_of(const Original& original, const MatchedModel& matched) {
    CollisionModel model;
    model.robot = original.robot;
    model.elements.resize(model.robot->links.size());
    model.sources.resize(model.robot->links.size(), CollisionModel::Source::none);
    model.notes = original.notes;
    model.notes.insert(model.notes.end(), matched.notes.begin(), matched.notes.end());
    for (std::size_t i = 0; i < original.links.size(); ++i) {
        const std::size_t link = index_of(*model.robot, original.links[i].link);
        model.elements[link] = matched.elements[i];
        const Elements& elements = matched.elements[i];
        if (!elements.empty()) {
            model.sources[link] = covers(*original.links[i].solid, elements) ? CollisionModel::Source::cover
                                                                             : CollisionModel::Source::given;
        }
    }
    take_solids(original, model);
    require_pairs(model);
    return model;
}

} // namespace foam::judge
