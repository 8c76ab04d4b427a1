#include <foam/robot/robot.hpp>

#include <algorithm>

namespace foam::inline robot {
namespace {

bool same_geometry(const Geometry& a, const Geometry& b) {
    const auto* mesh = std::get_if<MeshReference>(&a);
    const auto* other = std::get_if<MeshReference>(&b);
    if (mesh && other) {
        const bool same = mesh->mesh == other->mesh || (mesh->mesh && other->mesh && *mesh->mesh == *other->mesh);
        return same && mesh->path == other->path && mesh->scale == other->scale;
    }
    return !mesh && !other && std::get<Element>(a) == std::get<Element>(b);
}

bool has(const std::vector<GeometryElement>& elements, const GeometryElement& element) {
    return std::any_of(elements.begin(), elements.end(), [&](const GeometryElement& other) {
        return other.origin == element.origin && same_geometry(other.geometry, element.geometry);
    });
}

} // namespace

const std::vector<std::string>& words_of_covered_geometry() {
    static const std::vector<std::string> words{"collision", "visual", "both", "collision-or-visual"};
    return words;
}

const char* to_string(CoveredGeometry geometry) {
    switch (geometry) {
    case CoveredGeometry::collision:
        return "collision geometry";
    case CoveredGeometry::visual:
        return "visual geometry";
    case CoveredGeometry::both:
        return "collision and visual geometry";
    case CoveredGeometry::collision_or_visual:
        return "collision or visual geometry";
    }
    return "";
}

Robot with_covered_geometry(Robot robot, CoveredGeometry geometry) {
    if (geometry == CoveredGeometry::collision) {
        return robot;
    }
    for (Link& link : robot.links) {
        if (geometry == CoveredGeometry::visual) {
            link.collisions = link.visuals;
            continue;
        }
        if (geometry == CoveredGeometry::collision_or_visual && !link.collisions.empty()) {
            continue;
        }
        for (const GeometryElement& visual : link.visuals) {
            if (!has(link.collisions, visual)) {
                link.collisions.push_back(visual);
            }
        }
    }
    return robot;
}

std::vector<std::string> uncovered_links(const Robot& robot, CoveredGeometry geometry) {
    std::vector<std::string> names;
    for (const Link& link : robot.links) {
        if (geometry == CoveredGeometry::visual && link.visuals.empty() && !link.collisions.empty()) {
            names.push_back(link.name);
        }
    }
    return names;
}

} // namespace foam::inline robot
