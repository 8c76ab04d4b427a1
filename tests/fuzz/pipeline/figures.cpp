#include "figures.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace foam::fuzz {
namespace {

bool sound(const Sphere& sphere) {
    return is_finite(sphere.center) && std::isfinite(sphere.radius) && sphere.radius > 0;
}

bool all_sound(const SphereTree& tree) {
    return !tree.levels.empty() && std::all_of(tree.levels.begin(), tree.levels.end(), [](const auto& level) {
        return level.elements.size() > 0 && std::all_of(level.elements.spheres().begin(), level.elements.spheres().end(), sound) &&
               std::all_of(level.elements.shaped().begin(), level.elements.shaped().end(), is_valid);
    });
}

std::string odd_measure(const Measures& m) {
    const std::pair<const char*, double> figures[] = {{"area", m.area},
                                                      {"volume", m.volume},
                                                      {"covered", m.covered},
                                                      {"gap", m.gap},
                                                      {"excess", m.excess},
                                                      {"excess_error", m.excess_error},
                                                      {"missing", m.missing},
                                                      {"missing_error", m.missing_error},
                                                      {"exposed_area", m.exposed_area},
                                                      {"protrusion_max", m.protrusion_max},
                                                      {"protrusion_mean", m.protrusion_mean},
                                                      {"excess_volume", m.excess_volume},
                                                      {"missing_volume", m.missing_volume}};
    for (const auto& [name, value] : figures) {
        if (!(value >= 0)) {
            return std::string(name) + " is " + text_of_number(value);
        }
    }
    return "";
}

/// A radius at which some ball holds all points: that of Bădoiu and Clarkson 2003, within a few per cent of the least.
double bounding_radius(const std::vector<Vec3>& points) {
    Vec3 center = points.front();
    double radius = 0;
    for (int step = 1; step <= 200; ++step) {
        const Vec3* farthest = &points.front();
        for (const Vec3& p : points) {
            farthest = distance(center, p) > distance(center, *farthest) ? &p : farthest;
        }
        radius = distance(center, *farthest);
        center = center + (1.0 / (step + 1)) * (*farthest - center);
    }
    return radius;
}

/// Surfaces have vertices that no triangle uses, too.
std::vector<Vec3> corners_of(const Mesh& mesh) {
    std::vector<Vec3> corners;
    for (const Triangle& t : mesh.triangles) {
        for (const std::uint32_t corner : t) {
            corners.push_back(mesh.vertices[corner]);
        }
    }
    return corners;
}

bool excess_first(const Recipe& recipe, const std::string& link) {
    const Recipe::LinkRecipe own = recipe.for_link(link);
    const auto objective = own.spherizer.given.find("objective");
    return recipe.guarantee == Guarantee::outer && recipe.per_link && own.clip.empty() &&
           !own.spherizer.stage.starts_with("approximate.") && // a box around a ball has more than the ball
           (objective == own.spherizer.given.end() || to_text(objective->second) == "excess");
}

} // namespace

std::string text_of_number(double value) {
    char text[40];
    std::snprintf(text, sizeof text, "%.6g", value);
    return text;
}

std::vector<std::string> odd_figures(const RunResult& result, const Recipe& recipe) {
    std::vector<std::string> findings;
    for (const SphereGroup& group : result.model.groups) {
        if (!all_sound(group.tree)) {
            findings.push_back("link '" + group.link + "' has spheres that are not finite, or none");
        }
        if (const std::string odd = odd_measure(group.measures); !odd.empty()) {
            findings.push_back("figure of link '" + group.link + "': " + odd);
        }
    }
    if (const std::string odd = odd_measure(result.total); !odd.empty()) {
        findings.push_back("figure of the whole: " + odd);
    }
    bool whole = true;
    for (const LinkReport& link : result.links) {
        const bool left_out = link.skipped || !link.error.empty();
        whole = whole && !left_out;
        if (recipe.guarantee != Guarantee::fitted && !left_out && !link.measures.certified) {
            findings.push_back("written, but not certified: link '" + link.link + "'");
        }
    }
    if (recipe.guarantee != Guarantee::fitted && whole && !result.certified) {
        findings.push_back("written, but not certified");
    }
    return findings;
}

std::vector<std::string> excess_findings(const Original& original, const RunResult& result, const Recipe& recipe) {
    std::vector<std::string> findings;
    for (const LinkReport& link : result.links) {
        const auto found = std::find_if(original.links.begin(), original.links.end(),
                                        [&](const OriginalLink& o) { return o.link == link.link; });
        const Measures& m = link.measures;
        if (found == original.links.end() || link.skipped || !link.error.empty() || !(m.volume > 0) ||
            !excess_first(recipe, link.link)) {
            continue;
        }
        const double radius = bounding_radius(corners_of(found->solid->surface()));
        const double ball = 4.0 / 3 * std::numbers::pi * radius * radius * radius;
        if (m.excess_volume - 4 * m.excess_volume_error > 1.05 * ball - m.volume + 4 * m.volume_error) {
            findings.push_back("excess: " + text_of_number(m.excess_volume / (ball - m.volume)) +
                               " times that of a bounding sphere, link '" + link.link + "'");
        }
    }
    return findings;
}

} // namespace foam::fuzz
