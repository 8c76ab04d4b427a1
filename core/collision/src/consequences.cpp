#include "link_shapes.hpp"
#include "pairs.hpp"

#include <foam/base/parallel.hpp>
#include <foam/collision/consequences.hpp>
#include <foam/collision/separation.hpp>

#include <algorithm>
#include <map>

namespace foam::inline collision {
namespace {

using namespace self_collision;

std::size_t size_of(const BallGroup& group) {
    return group.spheres.size() + group.shaped.size();
}

/// Returns the sphere around an element; spheres come first.
const Sphere& bound_of(const BallGroup& group, std::size_t i) {
    return i < group.spheres.size() ? group.spheres[i] : group.shaped[i - group.spheres.size()].bound;
}

Element element_at(const BallGroup& group, std::size_t i) {
    return i < group.spheres.size() ? element_of(group.spheres[i]) : group.shaped[i - group.spheres.size()].element;
}

/// Calls found(i, k) for the elements of two links that touch, until it returns false.
template <class Found>
void for_each_touching(const BallGroup& a, const BallGroup& b, const Pose& pose_a, const Pose& pose_b, Found found) {
    const Sphere whole_a = moved(pose_a, a.bound), whole_b = moved(pose_b, b.bound);
    if (!touch(whole_a, whole_b)) {
        return;
    }
    std::vector<std::pair<std::size_t, Sphere>> near;
    for (std::size_t k = 0; k < size_of(b); ++k) {
        if (const Sphere bound = moved(pose_b, bound_of(b, k)); touch(bound, whole_a)) {
            near.emplace_back(k, bound);
        }
    }
    for (std::size_t i = 0; i < size_of(a); ++i) {
        const Sphere bound = moved(pose_a, bound_of(a, i));
        if (!touch(bound, whole_b)) {
            continue;
        }
        for (const auto& [k, other] : near) {
            const bool spheres = i < a.spheres.size() && k < b.spheres.size(); // they are their bounds
            if (touch(bound, other) &&
                (spheres || separation(element_at(a, i), element_at(b, k), pose_a, pose_b).low == 0) && !found(i, k)) {
                return;
            }
        }
    }
}

/// What is counted in one configuration.
struct InPose {
    std::vector<char> contact, model;                        ///< of each pair
    std::vector<std::pair<std::size_t, std::size_t>> blamed; ///< link and element, once for each false contact
};

class Comparison {
public:
    Comparison(const Kinematics& kinematics, const CollisionModel& model, const LinkShapes& shapes, const LinkPairs& pairs)
        : kinematics_(kinematics), pairs_(pairs), shapes_(shapes), groups_(groups_of(model)) {}

    InPose in(std::span<const double> configuration) const {
        const std::vector<Pose> poses = kinematics_.link_poses(configuration);
        InPose result{std::vector<char>(pairs_.size(), 0), std::vector<char>(pairs_.size(), 0), {}};
        for (std::size_t p = 0; p < pairs_.size(); ++p) {
            const auto [a, b] = pairs_[p];
            result.contact[p] = shapes_.touching(a, b, poses);
            compare_model(p, poses, result);
        }
        return result;
    }

private:
    void compare_model(std::size_t p, const std::vector<Pose>& poses, InPose& result) const {
        const auto [a, b] = pairs_[p];
        if (!groups_[a] || !groups_[b]) {
            return;
        }
        std::vector<char> in_a(size_of(*groups_[a]), 0), in_b(size_of(*groups_[b]), 0);
        for_each_touching(*groups_[a], *groups_[b], poses[a], poses[b], [&](std::size_t i, std::size_t k) {
            result.model[p] = 1;
            in_a[i] = in_b[k] = 1;
            return !result.contact[p]; // of a false contact all elements are wanted
        });
        if (!result.contact[p]) {
            blame(a, in_a, result);
            blame(b, in_b, result);
        }
    }
    static void blame(std::size_t link, const std::vector<char>& touching, InPose& result) {
        for (std::size_t i = 0; i < touching.size(); ++i) {
            if (touching[i]) {
                result.blamed.emplace_back(link, i);
            }
        }
    }

    const Kinematics& kinematics_;
    const LinkPairs& pairs_;
    const LinkShapes& shapes_;
    Groups groups_;
};

/// Counts of elements by link.
class Blame {
public:
    void add(std::size_t link, std::size_t element) { ++counts_[{link, element}]; }

    std::vector<ElementConsequence> sorted() const {
        std::vector<ElementConsequence> elements;
        for (const auto& [place, count] : counts_) {
            elements.push_back({place.first, place.second, count});
        }
        std::stable_sort(elements.begin(), elements.end(),
                         [](const ElementConsequence& a, const ElementConsequence& b) {
                             return a.false_contacts > b.false_contacts;
                         });
        return elements;
    }

private:
    std::map<std::pair<std::size_t, std::size_t>, std::size_t> counts_;
};

void add(const InPose& pose, Consequences& sum, Blame& blame) {
    bool contact = false, refused = false;
    for (std::size_t p = 0; p < sum.pairs.size(); ++p) {
        PairConsequence& pair = sum.pairs[p];
        pair.contacts += pose.contact[p] ? 1 : 0;
        pair.missed += pose.contact[p] && !pose.model[p] ? 1 : 0;
        pair.false_contacts += pose.model[p] && !pose.contact[p] ? 1 : 0;
        contact = contact || pose.contact[p];
        refused = refused || pose.model[p];
    }
    sum.in_contact += contact ? 1 : 0;
    sum.refused += refused ? 1 : 0;
    sum.falsely_refused += refused && !contact ? 1 : 0;
    sum.missed += contact && !refused ? 1 : 0;
    for (const auto& [link, element] : pose.blamed) {
        blame.add(link, element);
    }
}

/// Returns the pairs of links with geometry that are not adjacent, but those whose geometry touches in every
/// configuration: no planner can avoid that contact. A pair that touches in the zero pose alone is checked.
LinkPairs pairs_to_check(const Kinematics& kinematics, const LinkShapes& shapes,
                         const std::vector<std::vector<double>>& given) {
    constexpr std::size_t random = 256;
    std::vector<std::vector<double>> configurations{kinematics.configuration()};
    configurations.insert(configurations.end(), given.begin(), given.end());
    for (std::vector<double>& configuration : random_configurations(kinematics, random, 0)) {
        configurations.push_back(std::move(configuration));
    }
    LinkPairs pairs = pairs_apart(kinematics, shapes);
    const LinkPairs always = touching_in_all(kinematics, shapes, pairs, configurations);
    std::erase_if(pairs, [&](const auto& pair) { return std::binary_search(always.begin(), always.end(), pair); });
    return pairs;
}

} // namespace

std::vector<std::vector<double>> random_configurations(const Kinematics& kinematics, std::size_t count,
                                                       std::uint64_t seed) {
    Random random(derive_seed(seed, "configurations"));
    std::vector<std::vector<double>> configurations;
    for (std::size_t i = 0; i < count; ++i) {
        configurations.push_back(kinematics.random_configuration(random));
    }
    return configurations;
}

Consequences consequences_of(const Kinematics& kinematics, const CollisionModel& model, const LinkSolids& solids,
                             const std::optional<LinkPairs>& given,
                             const std::vector<std::vector<double>>& configurations) {
    const LinkShapes shapes(solids);
    const LinkPairs pairs = given ? *given : pairs_to_check(kinematics, shapes, configurations);
    const Comparison comparison(kinematics, model, shapes, pairs);
    Consequences sum;
    sum.poses = configurations.size();
    for (const auto& [a, b] : pairs) {
        sum.pairs.push_back({a, b});
    }
    constexpr std::size_t at_once = 1024; // what is counted in a pose is kept for so many
    Blame blame;
    for (std::size_t begin = 0; begin < configurations.size(); begin += at_once) {
        std::vector<InPose> poses(std::min(at_once, configurations.size() - begin));
        parallel_for(poses.size(), [&](std::size_t i) { poses[i] = comparison.in(configurations[begin + i]); });
        for (const InPose& pose : poses) {
            add(pose, sum, blame);
        }
    }
    sum.elements = blame.sorted();
    return sum;
}

} // namespace foam::inline collision
