#include "elements.hpp"

#include "environment.hpp"

#include <foam/collision/separation.hpp>
#include <foam/geometry/element_forms.hpp>
#include <foam/robot/internal/chain.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace foam::inline bench {
namespace {

/// Returns the element that libraries check instead.
Element as_checked(const Element& element) {
    const bool unknown = element.kind == Element::Kind::swept_box || element.kind == Element::Kind::ellipsoid;
    return unknown ? enclosing_hull(element) : element;
}

EngineShape shape_of(const Element& given) {
    Element element = as_checked(given);
    const Pose pose = std::exchange(element.pose, Pose{});
    if (element.hull) {
        return {pose, std::make_shared<const Mesh>(element.hull->surface), true};
    }
    return {pose, element};
}

std::vector<Element> all_elements(const std::vector<LinkSpheres>& links) {
    std::vector<Element> all;
    for (const LinkSpheres& link : links) {
        std::transform(link.elements.begin(), link.elements.end(), std::back_inserter(all), as_checked);
    }
    return all;
}

/// Returns the element in a frame with the element's own axes, and with its origin at the centre of the bounds there.
Element centred(Element element) {
    element.pose = {};
    element.pose.translation = -bounds(element).center();
    return element;
}

bool overlap(const Box& a, const Box& b) {
    return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y && b.low.y <= a.high.y &&
           a.low.z <= b.high.z && b.low.z <= a.high.z;
}

} // namespace

EngineBody body_of(const Elements& elements) {
    EngineBody body;
    for (const Element& element : elements) {
        body.push_back(shape_of(element));
    }
    return body;
}

ElementRobot element_robot(const Kinematics& kinematics, const std::vector<LinkSpheres>& links) {
    ElementRobot result;
    const std::vector<Link>& all = kinematics.robot().links;
    std::vector<bool> has(all.size());
    for (std::size_t i = 0; i < all.size(); ++i) {
        const auto link = std::find_if(links.begin(), links.end(),
                                       [&](const LinkSpheres& elements) { return elements.link == all[i].name; });
        if (link != links.end()) {
            has[i] = true;
            result.links.push_back(i);
            result.robot.bodies.push_back(body_of(link->elements));
        }
    }
    const auto bodies = static_cast<std::uint32_t>(result.links.size());
    for (std::uint32_t a = 0; a < bodies; ++a) {
        for (std::uint32_t b = a + 1; b < bodies; ++b) {
            if (!joint_chain::adjacent(kinematics, has, result.links[a], result.links[b])) {
                result.robot.pairs.push_back({a, b});
            }
        }
    }
    return result;
}

std::size_t shape_pairs(const EngineRobot& robot) {
    std::size_t sum = 0;
    for (const auto& [a, b] : robot.pairs) {
        sum += robot.bodies[a].size() * robot.bodies[b].size();
    }
    return sum;
}

NearPairs::NearPairs(const std::vector<LinkSpheres>& links, std::size_t count, Random& random) {
    const std::vector<Element> all = all_elements(links);
    for (std::size_t i = 0; i < 2 * count; ++i) {
        elements_.push_back(centred(all[random.below(all.size())]));
        robot_.bodies.push_back({shape_of(elements_.back())});
    }
    for (std::size_t i = 0; i < count; ++i) {
        robot_.pairs.push_back({static_cast<std::uint32_t>(2 * i), static_cast<std::uint32_t>(2 * i + 1)});
    }
}

std::vector<Pose> NearPairs::poses(Random& random) const {
    constexpr double apart = 1e-3; // of their size: libraries may round a smaller gap away
    double size = 0;
    for (const Element& element : elements_) {
        size = std::max(size, bounds(element).diagonal());
    }
    std::vector<Pose> result;
    for (std::size_t i = 0; i < elements_.size(); i += 2) {
        const Element &a = elements_[i], &b = elements_[i + 1];
        const double reach = (bounds(a).diagonal() + bounds(b).diagonal()) / 2;
        Pose pose_a, pose_b;
        do {
            pose_a = random_rotation(random);
            pose_b = random_rotation(random);
            const Vec3 direction = random_rotation(random).rotation[0];
            pose_b.translation = random.uniform(0, reach) * direction;
        } while (separation(a, b, pose_a, pose_b).low < apart * reach ||
                 !overlap(bounds(moved(a, pose_a)), bounds(moved(b, pose_b))));
        const Vec3 place{3 * size * static_cast<double>(i / 2), 0, 0}; // away from the other pairs
        pose_a.translation = place;
        pose_b.translation += place;
        result.push_back(pose_a);
        result.push_back(pose_b);
    }
    return result;
}

} // namespace foam::bench
