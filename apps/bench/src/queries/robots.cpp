#include "robots.hpp"

#include "pairs.hpp"

#include <foam/base/error.hpp>
#include <foam/judge/evaluate.hpp>
#include <foam/runtime/internal/input.hpp>
#include <foam/runtime/internal/links.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace foam::inline bench {
namespace {

using SpheresByLink = std::map<std::string, std::vector<Sphere>>;

EngineBody body_of(const std::vector<Sphere>& spheres) {
    EngineBody body;
    for (const Sphere& sphere : spheres) {
        Pose pose;
        pose.translation = sphere.center;
        body.push_back({pose, Element::sphere(sphere.radius)});
    }
    return body;
}

/// Elements in the frame of the link.
EngineBody body_of(const LinkWork& link) {
    EngineBody body;
    for (const CollisionElement& element : link.elements) {
        if (const Element* primitive = element.primitive()) {
            body.push_back({element.source->origin, *primitive});
        } else {
            body.push_back({element.source->origin, element.raw});
        }
    }
    return body;
}

TwoModels two_models(const Workspace& workspace, const Input& input, const SpheresByLink& spheres) {
    TwoModels models;
    models.input = input.chosen;
    models.kinematics = std::make_shared<const Kinematics>(input.robot);
    std::vector<InputFile> files;
    for (const LinkWork& link : load_links(workspace, *input.robot, files)) {
        if (link.error) {
            throw Error(*link.error);
        }
        if (const auto it = spheres.find(link.link->name); it != spheres.end()) {
            models.links.push_back(static_cast<std::size_t>(link.link - input.robot->links.data()));
            models.original.bodies.push_back(body_of(link));
            models.spheres.bodies.push_back(body_of(it->second));
        }
    }
    models.original.pairs = tested_pairs(models, workspace.recipe.seed, workspace.options.cancel);
    models.spheres.pairs = models.original.pairs;
    const std::size_t bodies = models.links.size();
    models.ignored_pairs = bodies * (bodies - 1) / 2 - models.original.pairs.size();
    return models;
}

} // namespace

TwoModels with_made_spheres(const Workspace& workspace) {
    const RunResult made = run(workspace.recipe, workspace.registry, workspace.options);
    SpheresByLink spheres;
    for (LinkSpheres& link : spheres_by_link(made.model)) {
        spheres[link.link] = std::move(link.elements.spheres());
    }
    TwoModels models = two_models(workspace, load_input(workspace), spheres);
    models.certified = made.certified;
    models.excess = made.total.excess;
    return models;
}

TwoModels with_given_spheres(const Workspace& workspace, const std::filesystem::path& file) {
    const Input input = load_input(workspace);
    const Original original = load_original(input.file, workspace.registry);
    const MatchedModel matched = match(original, read_sphere_file(file, workspace.registry));
    SpheresByLink spheres;
    for (std::size_t i = 0; i < original.links.size(); ++i) {
        if (!matched.elements[i].are_spheres()) {
            throw Error(ErrorCode::usage, fmt::format("{}: link '{}' has other elements than spheres, which these "
                                                      "queries do not take; remedy: a model of spheres",
                                                      file.string(), original.links[i].link));
        }
        if (!matched.elements[i].empty()) {
            spheres[original.links[i].link] = matched.elements[i].spheres();
        }
    }
    TwoModels models = two_models(workspace, input, spheres);
    const std::vector<LinkProof> proofs = prove(original, matched, Guarantee::outer);
    models.certified = true;
    for (std::size_t i = 0; i < proofs.size(); ++i) {
        models.certified = models.certified && (proofs[i].holds || matched.elements[i].empty());
    }
    models.excess = evaluate(original, matched).with_spheres.measures.excess;
    return models;
}

} // namespace foam::bench
