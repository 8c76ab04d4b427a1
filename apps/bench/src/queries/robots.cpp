#include "robots.hpp"

#include "elements.hpp"
#include "pairs.hpp"

#include <foam/base/error.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace foam::inline bench {
namespace {

/// A link's geometry as it is.
EngineBody original_body(const Solid& solid) {
    EngineBody body;
    for (const Solid::Part& part : solid.parts()) {
        if (part.primitive) {
            body.push_back({part.pose, *part.primitive});
        } else {
            body.push_back({{}, part.mesh});
        }
    }
    return body;
}

} // namespace

std::vector<LinkSpheres> matched_elements(const Original& original, const std::filesystem::path& file,
                                          const Registry& registry) {
    const MatchedModel matched = match(original, read_sphere_file(file, registry));
    std::vector<LinkSpheres> links;
    for (std::size_t i = 0; i < original.links.size(); ++i) {
        if (!matched.elements[i].empty()) {
            links.push_back({original.links[i].link, matched.elements[i]});
        }
    }
    return links;
}

TwoModels two_models(const Original& original, const std::vector<LinkSpheres>& spheres, std::uint64_t seed) {
    TwoModels models;
    models.kinematics = std::make_shared<const Kinematics>(original.robot);
    for (const OriginalLink& link : original.links) {
        const auto own = std::find_if(spheres.begin(), spheres.end(),
                                      [&](const LinkSpheres& other) { return other.link == link.link; });
        if (own == spheres.end()) {
            continue;
        }
        if (!own->elements.are_spheres()) {
            throw Error(ErrorCode::usage, fmt::format("link '{}' has other elements than spheres, which these queries "
                                                      "do not take; remedy: a model of spheres",
                                                      link.link));
        }
        models.links.push_back(
            static_cast<std::size_t>(original.robot->find_link(link.link) - original.robot->links.data()));
        models.original.bodies.push_back(original_body(*link.solid));
        models.spheres.bodies.push_back(body_of(own->elements));
    }
    models.original.pairs = tested_pairs(models, seed);
    models.spheres.pairs = models.original.pairs;
    const std::size_t bodies = models.links.size();
    models.ignored_pairs = bodies * (bodies - 1) / 2 - models.original.pairs.size();
    return models;
}

} // namespace foam::inline bench
