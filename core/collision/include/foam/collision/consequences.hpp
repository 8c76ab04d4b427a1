// What a model of a robot does in its configurations, beside the original geometry: contacts that it misses, and poses
// that it refuses though nothing touches.
#pragma once

#include <foam/collision/self_collision.hpp>

#include <cstdint>
#include <optional>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] collision {

/// A pair of links that is checked; in how many poses…
struct PairConsequence {
    std::size_t first = 0, second = 0; ///< indices into robot.links, first < second
    std::size_t contacts = 0;          ///< …the original geometry touches
    std::size_t missed = 0;            ///< …it touches, but the model does not
    std::size_t false_contacts = 0;    ///< …the model touches, but the original geometry does not

    bool operator==(const PairConsequence&) const = default;
};

/// An element that takes part in false contacts.
struct ElementConsequence {
    std::size_t link = 0;           ///< index into robot.links
    std::size_t element = 0;        ///< index into the link's elements: spheres first, then the others
    std::size_t false_contacts = 0; ///< of pairs of links, summed over the poses

    bool operator==(const ElementConsequence&) const = default;
};

struct Consequences {
    std::size_t poses = 0;
    std::size_t in_contact = 0;               ///< poses in which the original geometry of a checked pair touches
    std::size_t refused = 0;                  ///< poses in which the model of a checked pair touches
    std::size_t falsely_refused = 0;          ///< refused poses in which no original geometry touches
    std::size_t missed = 0;                   ///< poses in contact that are not refused
    std::vector<PairConsequence> pairs;       ///< all that are checked, in the order of the links
    std::vector<ElementConsequence> elements; ///< those with false contacts, most of them first

    bool operator==(const Consequences&) const = default;
};

/// Returns `count` configurations, uniform within the limits: equal seeds give equal configurations.
std::vector<std::vector<double>> random_configurations(const Kinematics& kinematics, std::size_t count,
                                                       std::uint64_t seed);

/// Compares the model with the original geometry in each configuration. A contact of the original geometry is certain:
/// a triangle passes through another, or a piece lies inside; round primitives count as polyhedra of 96 sides within
/// them. Links without elements never touch. `pairs`: those that are checked; nothing: the pairs of links with geometry
/// but those joined by at most one moving joint with no geometry in between, and those whose geometry touches in every
/// configuration: the given ones, the zero pose and 256 random ones. The result is the same on any number of threads. Throws Error(cancelled).
Consequences consequences_of(const Kinematics& kinematics, const CollisionModel& model, const LinkSolids& solids,
                             const std::optional<LinkPairs>& pairs,
                             const std::vector<std::vector<double>>& configurations);

} // namespace collision
} // namespace foam
