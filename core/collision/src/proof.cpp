#include "pairs.hpp"

#include <foam/collision/separation.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

namespace foam::inline collision::self_collision {
namespace {

/// m; far above the rounding errors of poses and distances of a robot with a size of some metres (1e-14 m), far below
/// the margins of proofs.
constexpr double rounding = 1e-9;

struct JointBox {
    std::vector<double> middle, half; ///< of each freedom; freedoms that are not between the links stay unchanged
    double share = 1;                 ///< of the volume of all joint positions
};

/// One end of the chain: its spheres and their motion.
class MovingLink {
public:
    MovingLink(Chain chain, const BallGroup& group)
        : chain_(std::move(chain)), group_(group), axes_(chain_.steps.size()), turn_(chain_.steps.size()) {}

    void place(const JointBox& box) {
        pose_ = forward(chain_, box.middle, axes_);
        for (std::size_t i = 0; i < chain_.steps.size(); ++i) {
            const Step& step = chain_.steps[i];
            const double half = std::abs(step.motion.multiplier) * box.half[*step.motion.freedom];
            // A rotation by an angle moves a point by the chord of that angle.
            turn_[i] = prismatic(step) ? half : 2 * std::sin(std::min(half, std::numbers::pi) / 2);
        }
    }

    const Pose& pose() const { return pose_; }
    const BallGroup& group() const { return group_; }

    /// Returns an upper bound on the displacement within the box of a point fixed to the link, which is at `point` in
    /// the middle of the box. From the last joint to the first: the displacement by later joints adds to the distance
    /// from the axis.
    double displacement(const Vec3& point) const { return displacement(Sphere{point, 0}); }

    /// Returns the same for all points within a ball.
    double displacement(const Sphere& ball) const {
        double moved = 0;
        for (std::size_t i = chain_.steps.size(); i-- > 0;) {
            moved += moved_by(i, ball.center, ball.radius + moved);
        }
        return moved;
    }

    /// Adds to each freedom how far its joints may move the link's farthest point.
    void add_shares(std::vector<double>& shares) const {
        const Vec3 center = pose_ * group_.bound.center;
        double moved = group_.bound.radius;
        for (std::size_t i = chain_.steps.size(); i-- > 0;) {
            const double more = moved_by(i, center, moved);
            shares[*chain_.steps[i].motion.freedom] += more;
            moved += more;
        }
    }

private:
    static bool prismatic(const Step& step) { return step.joint->kind == Joint::Kind::prismatic; }

    double moved_by(std::size_t i, const Vec3& point, double moved) const {
        if (prismatic(chain_.steps[i])) {
            return turn_[i];
        }
        return turn_[i] * (norm(cross(point - axes_[i].origin, axes_[i].direction)) + moved);
    }

    Chain chain_;
    const BallGroup& group_;
    std::vector<Axis> axes_;
    std::vector<double> turn_; ///< of each step; m for prismatic, chord of the unit circle for others
    Pose pose_;
};

/// The result for the links within one box.
struct Look {
    bool apart = false, touching = false; ///< in the whole box
    bool touching_in_the_middle = false;
};

class Search {
public:
    Search(const Kinematics& kinematics, SplitChain chains, const BallGroup& first, const BallGroup& second)
        : kinematics_(kinematics), first_(std::move(chains.first), first), second_(std::move(chains.second), second) {}

    Verdict run(const std::vector<std::size_t>& freedoms, std::size_t boxes, const std::atomic<bool>* cancel) {
        std::vector<JointBox> waiting{whole(freedoms)};
        bool all_apart = true, all_touching = true;
        double decided = 0;
        for (std::size_t i = 0; !waiting.empty(); ++i) {
            if (i == boxes || hopeless(i, decided, boxes) || (cancel && cancel->load(std::memory_order_relaxed))) {
                return Verdict::unknown;
            }
            JointBox box = std::move(waiting.back());
            waiting.pop_back();
            const Look look = look_at(box);
            (look.touching_in_the_middle ? all_apart : all_touching) = false;
            if (!all_apart && !all_touching) {
                return Verdict::some;
            }
            if (freedoms.empty()) {
                break; // there is only one configuration
            }
            if (!look.apart && !look.touching) {
                halve(std::move(box), freedoms, waiting);
            } else {
                decided += box.share;
            }
        }
        return all_apart ? Verdict::never : Verdict::always;
    }

    /// Returns an upper bound on the links' displacement over the whole limits, m.
    double largest_displacement(const std::vector<std::size_t>& freedoms) {
        place(whole(freedoms));
        const std::vector<double>& each = shares();
        return std::accumulate(each.begin(), each.end(), 0.0);
    }

private:
    /// Returns whether the share that is decided after `looked` boxes leaves no hope for a proof within `boxes`.
    static bool hopeless(std::size_t looked, double decided, std::size_t boxes) {
        constexpr std::size_t trial = 512;
        return looked >= trial && static_cast<double>(looked) > decided * static_cast<double>(boxes);
    }
    JointBox whole(const std::vector<std::size_t>& freedoms) const {
        JointBox box{kinematics_.configuration(), std::vector<double>(kinematics_.freedoms().size(), 0.0), 1};
        for (const std::size_t f : freedoms) {
            const Freedom& freedom = kinematics_.freedoms()[f];
            box.middle[f] = (freedom.lower + freedom.upper) / 2;
            box.half[f] = (freedom.upper - freedom.lower) / 2;
        }
        return box;
    }

    void place(const JointBox& box) {
        first_.place(box);
        second_.place(box);
    }

    /// Returns for each freedom how far it may move the links within the current box, m.
    const std::vector<double>& shares() {
        shares_.assign(kinematics_.freedoms().size(), 0.0);
        first_.add_shares(shares_);
        second_.add_shares(shares_);
        return shares_;
    }

    double displacement(const Sphere& a, const Sphere& b) const {
        return first_.displacement(a.center) + second_.displacement(b.center) + rounding;
    }

    Look look_at(const JointBox& box) {
        place(box);
        const Sphere a = moved(first_.pose(), first_.group().bound);
        const Sphere b = moved(second_.pose(), second_.group().bound);
        if (gap(a, b) > displacement(a, b)) {
            return {.apart = true};
        }
        return look_closely(a, b);
    }

    /// Compares sphere by sphere, after spheres that cannot reach any of the other link are left out.
    Look look_closely(const Sphere& first_bound, const Sphere& second_bound) {
        near_.clear();
        const double first_moves = first_.displacement(first_bound.center);
        for (const Sphere& sphere : second_.group().spheres) {
            const Sphere b = moved(second_.pose(), sphere);
            const double b_moves = second_.displacement(b.center);
            if (gap(first_bound, b) <= first_moves + b_moves + rounding) {
                near_.push_back({b, b_moves});
            }
        }
        Look look{.apart = true};
        for (const Sphere& sphere : first_.group().spheres) {
            const Sphere a = moved(first_.pose(), sphere);
            const double a_moves = first_.displacement(a.center);
            if (gap(a, second_bound) > a_moves + second_.displacement(second_bound.center) + rounding) {
                continue;
            }
            for (const auto& [b, b_moves] : near_) {
                const double apart = gap(a, b);
                const double move = a_moves + b_moves + rounding;
                look.apart = look.apart && apart > move;
                look.touching = look.touching || apart < -move;
                look.touching_in_the_middle = look.touching_in_the_middle || apart <= 0;
            }
        }
        if (!first_.group().shaped.empty() || !second_.group().shaped.empty()) {
            look_at_others(look);
        }
        return look;
    }

    /// Compares the pairs of elements of which at least one is no sphere.
    void look_at_others(Look& look) {
        const std::vector<BoundedElement> balls = spheres_of(second_.group());
        for (const BoundedElement& a : first_.group().shaped) {
            compare(a, second_.group().shaped, look);
            compare(a, balls, look);
        }
        for (const BoundedElement& a : spheres_of(first_.group())) {
            compare(a, second_.group().shaped, look);
        }
    }

    static std::vector<BoundedElement> spheres_of(const BallGroup& group) {
        std::vector<BoundedElement> balls;
        for (const Sphere& sphere : group.spheres) {
            balls.push_back({element_of(sphere), sphere});
        }
        return balls;
    }

    void compare(const BoundedElement& element, const std::vector<BoundedElement>& others, Look& look) {
        const Sphere a = moved(first_.pose(), element.bound);
        const double a_moves = first_.displacement(a);
        for (const BoundedElement& other : others) {
            const Sphere b = moved(second_.pose(), other.bound);
            const double move = a_moves + second_.displacement(b) + rounding;
            if (gap(a, b) > move) {
                continue;
            }
            const Separation between = separation(element.element, other.element, first_.pose(), second_.pose());
            look.apart = look.apart && between.low > move;
            look.touching = look.touching || between.depth > move;
            look.touching_in_the_middle = look.touching_in_the_middle || between.low == 0;
        }
    }

    /// Halves the box along the freedom that moves the links most.
    void halve(JointBox box, const std::vector<std::size_t>& freedoms, std::vector<JointBox>& waiting) {
        const std::vector<double>& each = shares();
        const std::size_t widest = *std::max_element(freedoms.begin(), freedoms.end(),
                                                     [&](std::size_t f, std::size_t g) { return each[f] < each[g]; });
        box.half[widest] /= 2;
        box.share /= 2;
        JointBox other = box;
        box.middle[widest] -= box.half[widest];
        other.middle[widest] += other.half[widest];
        waiting.push_back(std::move(other));
        waiting.push_back(std::move(box));
    }

    struct Near {
        Sphere sphere;
        double moves;
    };
    const Kinematics& kinematics_;
    MovingLink first_, second_;
    std::vector<Near> near_;
    std::vector<double> shares_;
};

} // namespace

std::vector<std::size_t> freedoms_of(const Chain& chain) {
    std::vector<std::size_t> freedoms;
    for (const Step& step : chain.steps) {
        freedoms.push_back(*step.motion.freedom);
    }
    std::sort(freedoms.begin(), freedoms.end());
    freedoms.erase(std::unique(freedoms.begin(), freedoms.end()), freedoms.end());
    return freedoms;
}

Verdict touching_verdict(const Kinematics& kinematics, const Chain& chain, const BallGroup& first,
                         const BallGroup& second, std::size_t boxes, const std::atomic<bool>* cancel) {
    const std::vector<std::size_t> freedoms = freedoms_of(chain);
    // In the frame of a link in the middle both ends move, each by the joints on its side only, and so by less.
    std::size_t best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t cut = 0; cut <= chain.steps.size(); ++cut) {
        const double moves = Search(kinematics, split(chain, cut), first, second).largest_displacement(freedoms);
        if (moves < least) {
            least = moves;
            best = cut;
        }
    }
    return Search(kinematics, split(chain, best), first, second).run(freedoms, boxes, cancel);
}

} // namespace foam::collision::self_collision
