#include "pairs.hpp"

#include <foam/base/random.hpp>
#include <foam/collision/separation.hpp>

#include <algorithm>
#include <limits>

namespace foam::inline collision::self_collision {
namespace {

/// The distance of the two links, as a function of the joints between them.
class Distance {
public:
    Distance(const joint_chain::Chain& chain, const BallGroup& first, const BallGroup& second)
        : chain_(chain), first_(first), second_(second), axes_(chain.steps.size()) {}

    /// Returns the distance of the spheres around the links, m; negative where they overlap.
    double of_bounds(std::span<const double> configuration) {
        return gap(first_.bound, moved(forward(chain_, configuration, axes_), second_.bound));
    }
    /// Returns the distance of the two nearest elements, m; not above 0 where they touch.
    double of_elements(std::span<const double> configuration) {
        pose_ = forward(chain_, configuration, axes_);
        least_ = std::numeric_limits<double>::infinity();
        const Sphere whole = moved(pose_, second_.bound);
        for (const Sphere& a : first_.spheres) {
            if (gap(a, whole) < least_) {
                compare_sphere(a);
            }
        }
        for (const BoundedElement& a : first_.shaped) {
            compare(a, second_.shaped);
            for (const Sphere& b : second_.spheres) {
                compare(a, {element_of(b), b});
            }
        }
        return least_;
    }

private:
    void compare_sphere(const Sphere& a) {
        for (const Sphere& b : second_.spheres) {
            least_ = std::min(least_, gap(a, moved(pose_, b)));
        }
        if (!second_.shaped.empty()) {
            compare({element_of(a), a}, second_.shaped);
        }
    }
    void compare(const BoundedElement& a, const std::vector<BoundedElement>& others) {
        for (const BoundedElement& b : others) {
            compare(a, b);
        }
    }
    void compare(const BoundedElement& a, const BoundedElement& b) {
        if (gap(a.bound, moved(pose_, b.bound)) < least_) {
            const Separation between = separation(a.element, b.element, {}, pose_);
            least_ = std::min(least_, between.low > 0 ? between.low : -between.depth);
        }
    }

    const joint_chain::Chain& chain_;
    const BallGroup &first_, &second_;
    std::vector<joint_chain::Axis> axes_;
    Pose pose_;
    double least_ = 0;
};

/// Returns whether a descent from a configuration ends in contact.
bool descends_to_contact(Distance& distance, const Kinematics& kinematics, const std::vector<std::size_t>& freedoms,
                         std::vector<double> at) {
    constexpr double first_step = 0.25, last_step = 1e-3; // shares of a joint's range
    double least = distance.of_elements(at);
    for (double step = first_step; step >= last_step && least > 0;) {
        const double before = least;
        for (const std::size_t f : freedoms) {
            const Freedom& freedom = kinematics.freedoms()[f];
            const double here = at[f], width = step * (freedom.upper - freedom.lower);
            for (const double moved_to : {here + width, here - width}) {
                at[f] = std::clamp(moved_to, freedom.lower, freedom.upper);
                const double now = distance.of_elements(at);
                if (now < least) {
                    least = now;
                    break;
                }
                at[f] = here;
            }
        }
        step = least < before ? step : step / 2;
    }
    return least <= 0;
}

} // namespace

bool touch_somewhere(const Kinematics& kinematics, const joint_chain::Chain& chain, const BallGroup& first,
                     const BallGroup& second, std::uint64_t seed) {
    constexpr std::size_t tried = 64, starts = 3;
    const std::vector<std::size_t> freedoms = freedoms_of(chain);
    Distance distance(chain, first, second);
    if (freedoms.empty()) {
        return distance.of_elements(kinematics.configuration()) <= 0;
    }
    Random random(seed);
    std::vector<std::pair<double, std::vector<double>>> nearest;
    for (std::size_t i = 0; i < tried; ++i) {
        std::vector<double> configuration = kinematics.random_configuration(random);
        nearest.emplace_back(distance.of_bounds(configuration), std::move(configuration));
    }
    std::partial_sort(nearest.begin(), nearest.begin() + starts, nearest.end());
    return std::any_of(nearest.begin(), nearest.begin() + starts, [&](const auto& start) {
        return descends_to_contact(distance, kinematics, freedoms, start.second);
    });
}

} // namespace foam::inline collision::self_collision
