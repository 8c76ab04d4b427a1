#include "ball_group.hpp"

#include <foam/collision/separation.hpp>

#include <algorithm>

namespace foam::inline collision::self_collision {

bool shaped_touch(const BallGroup& a, const Pose& pose_a, const BallGroup& b, const Pose& pose_b) {
    const auto meet = [&](const Element& e, const Sphere& bound_of_e, const Element& f, const Sphere& bound_of_f) {
        return touch(moved(pose_a, bound_of_e), moved(pose_b, bound_of_f)) && separation(e, f, pose_a, pose_b).low == 0;
    };
    for (const BoundedElement& f : b.shaped) {
        for (const BoundedElement& e : a.shaped) {
            if (meet(e.element, e.bound, f.element, f.bound)) {
                return true;
            }
        }
        for (const Sphere& e : a.spheres) {
            if (meet(element_of(e), e, f.element, f.bound)) {
                return true;
            }
        }
    }
    for (const BoundedElement& e : a.shaped) {
        for (const Sphere& f : b.spheres) {
            if (meet(e.element, e.bound, element_of(f), f)) {
                return true;
            }
        }
    }
    return false;
}

bool touch(const BallGroup& a, const Pose& pose_a, const BallGroup& b, const Pose& pose_b) {
    const Sphere bound_of_a = moved(pose_a, a.bound);
    std::vector<Sphere> near;
    for (const Sphere& sphere : b.spheres) {
        if (const Sphere here = moved(pose_b, sphere); touch(bound_of_a, here)) {
            near.push_back(here);
        }
    }
    const auto touches_near = [&](const Sphere& sphere) {
        const Sphere here = moved(pose_a, sphere);
        return std::any_of(near.begin(), near.end(), [&](const Sphere& other) { return touch(here, other); });
    };
    return (!near.empty() && std::any_of(a.spheres.begin(), a.spheres.end(), touches_near)) ||
           shaped_touch(a, pose_a, b, pose_b);
}

} // namespace foam::inline collision::self_collision
