// Volume of a union of balls in closed form: Gauss's theorem over the exposed parts of the spheres, Stokes's theorem
// over each part. Only integrals along arcs of circles remain. No vertex of the arrangement has to be computed, so
// degenerate arrangements are safe (cf. Buša et al. 2005, "ARVO: a Fortran package for computing the solvent accessible
// surface area and the excluded volume of overlapping spheres via analytic equations").
#include <foam/base/cancellation.hpp>
#include <foam/geometry/internal/measure_parts.hpp>
#include <foam/geometry/volumes.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <numbers>

namespace foam::inline geometry {
namespace {

using std::numbers::pi;

/// The part of a unit sphere that another ball hides: the points p with p · axis > height.
struct Cap {
    Vec3 axis;
    double height;
};

/// An angle t in [−π, π], by cos t and sin t: sines and arcs are not computed where angles are only compared.
struct Angle {
    static Angle of(double cosine, double sine) {
        // (x, y) points along (cos t/2, sin t/2); the other form of the same near ±π, where 1 + cos t is not exact.
        const double x = cosine < 0 ? std::abs(sine) : 1 + cosine;
        const double y = cosine < 0 ? std::copysign(1 - cosine, sine) : sine;
        return {cosine, sine, x, y, y / (x + std::abs(y))};
    }

    double cosine, sine;
    double x, y; ///< of the half angle, times a positive factor
    double rank; ///< rises with t
};

constexpr Angle first_angle{-1, 0, 0, -1, -1}, last_angle{-1, 0, 0, 1, 1}; ///< −π and π

struct Interval {
    Angle begin, end;
};

/// The circle around a cap: axis · height + width · (u cos t + v sin t), t from −π to π. The third component of v is 0.
struct Circle {
    explicit Circle(const Cap& cap)
        : axis(cap.axis), height(cap.height), width(std::sqrt((1 - height) * (1 + height))) {
        const double level = std::sqrt(axis.x * axis.x + axis.y * axis.y);
        v = level > 0 ? Vec3{-axis.y / level, axis.x / level, 0} : Vec3{0, 1, 0};
        u = cross(v, axis);
    }

    Vec3 axis;
    double height, width;
    Vec3 u, v;
};

/// Difference below which two caps are the same. A boundary that two caps share belongs to the first.
constexpr double same = 1e-13;

/// p · cap.axis − cap.height = depth + amplitude · cos(t − middle) along a circle, with amplitude (cos middle, sin
/// middle) = (a, b).
struct Heights {
    double depth, a, b;
};

/// The heights of a circle in each of some caps, of which only few matter to it. The coordinates stand apart, so that
/// compilers vectorise.
class HeightTable {
public:
    explicit HeightTable(const std::vector<Cap>& caps) : rows_(caps.size()) {
        for (Row* const row : {&x_, &y_, &z_, &height_, &depth_, &a_, &b_}) {
            row->resize(rows_);
        }
        for (std::size_t j = 0; j < rows_; ++j) {
            x_[j] = caps[j].axis.x;
            y_[j] = caps[j].axis.y;
            z_[j] = caps[j].axis.z;
            height_[j] = caps[j].height;
        }
    }
    void look(const Circle& circle) {
        const Vec3 axis = circle.axis, u = circle.u, v = circle.v;
        const double height = circle.height, width = circle.width;
        for (std::size_t j = 0; j < rows_; ++j) {
            depth_[j] = height * (axis.x * x_[j] + axis.y * y_[j] + axis.z * z_[j]) - height_[j];
            a_[j] = width * (u.x * x_[j] + u.y * y_[j] + u.z * z_[j]);
            b_[j] = width * (v.x * x_[j] + v.y * y_[j] + v.z * z_[j]);
        }
    }
    Heights of(std::size_t cap) const { return {depth_[cap], a_[cap], b_[cap]}; }

private:
    using Row = std::vector<double>;
    std::size_t rows_;
    Row x_, y_, z_, height_, depth_, a_, b_;
};

/// Returns whether the depth exceeds the amplitude by more than rounding, as for most caps: the circle is entirely in
/// the cap, or entirely outside. Lengths are slower to compute than squares.
bool beyond_amplitude(const Heights& heights) {
    constexpr double deep = 1e-3, rounding = 1e-12;
    const auto& [depth, a, b] = heights;
    return std::abs(depth) > deep && depth * depth > (a * a + b * b) * (1 + rounding);
}

/// Adds the angles at which a cap hides the circle, by its heights there. Returns false if it hides the whole circle.
/// `first`: of two equal caps, this one counts.
bool add_hidden(const Circle& circle, const Cap& cap, const Heights& heights, bool first,
                std::vector<Interval>& hidden) {
    const auto& [depth, a, b] = heights;
    if (beyond_amplitude(heights)) {
        return depth < 0;
    }
    const double amplitude = std::sqrt(a * a + b * b);
    if (amplitude <= same && std::abs(depth) <= same) {
        return !(first && dot(circle.axis, cap.axis) > 0);
    }
    if (depth >= amplitude) {
        return false;
    }
    if (depth <= -amplitude) {
        return true;
    }
    // From middle − half to middle + half, with half between 0 and π.
    const double cosine = -depth / amplitude, sine = std::sqrt((1 - cosine) * (1 + cosine));
    const double x = a / amplitude, y = b / amplitude;
    const Angle begin = Angle::of(x * cosine + y * sine, y * cosine - x * sine);
    const Angle end = Angle::of(x * cosine - y * sine, y * cosine + x * sine);
    if (begin.rank <= end.rank) {
        hidden.push_back({begin, end});
    } else {
        hidden.push_back({first_angle, end});
        hidden.push_back({begin, last_angle});
    }
    return true;
}

struct Exposed : ExposedPart {
    /// Subtracts an arc of the boundary, traversed with the exposed part on its right and the cap on its left.
    void subtract(const Circle& c, const Interval& arc) {
        const double angle = 2 * half_angle(arc, 1);
        // ∫ n dA = ½ ∮ p × dp
        const Vec3 swept =
            c.width * c.width * angle * c.axis -
            c.height * c.width * ((arc.end.sine - arc.begin.sine) * c.u - (arc.end.cosine - arc.begin.cosine) * c.v);
        normal += -0.5 * swept;
        // A = ∮ (x dy − y dx) / (1 + z), z = p · (0, 0, 1), is −height ∫ dt + (axis.z + height) ∫ dt / (1 + z), where
        // 1 + z = C + D cos t. The primitive of the last is 2 atan(ratio · tan(t / 2)).
        const double constant = 1 + c.axis.z * c.height, slope = c.width * c.u.z;
        const double sign = c.axis.z + c.height < 0 ? -1 : 1; // a cap whose edge meets the pole does not hide it
        // A circle without width about the pole has a ratio of 1.
        const double ratio = std::sqrt(std::max(constant - slope, 1e-300) / std::max(constant + slope, 1e-300));
        area -= -c.height * angle + sign * 2 * half_angle(arc, ratio);
    }

private:
    /// Returns the angle between the half angles of the ends, in [0, π], once their y are multiplied by `ratio`.
    static double half_angle(const Interval& arc, double ratio) {
        const double from = ratio * arc.begin.y, to = ratio * arc.end.y;
        return std::atan2(to * arc.begin.x - arc.end.x * from, arc.end.x * arc.begin.x + to * from);
    }
};

/// Turns the axes so that no ball of a symmetrical arrangement has its neighbours at the poles, where the integrand of
/// the area is singular.
Vec3 askew(const Vec3& v) {
    static const Vec3 x = normalized(Vec3{0.8131, 0.4377, -0.3849});
    static const Vec3 y = normalized(cross(Vec3{0.2917, -0.7193, 0.6307}, x));
    static const Vec3 z = cross(x, y);
    return {dot(x, v), dot(y, v), dot(z, v)};
}

bool meet(const Sphere& a, const Sphere& b) {
    const double sum = a.radius + b.radius;
    return squared_norm(b.center - a.center) < sum * sum;
}

/// Finds the balls that a ball meets: those far away along x are never looked at.
class Neighbours {
public:
    explicit Neighbours(std::span<const Sphere> balls) : balls_(balls) {
        for (std::uint32_t i = 0; i < balls.size(); ++i) {
            by_x_.emplace_back(balls[i].center.x, i);
            largest_ = std::max(largest_, balls[i].radius);
        }
        std::sort(by_x_.begin(), by_x_.end());
    }
    std::span<const Sphere> balls() const { return balls_; }
    /// Returns the indices of the other balls that meet ball `i`, ascending.
    std::vector<std::uint32_t> of(std::size_t i) const {
        constexpr double rounding = 1 + 1e-12;
        const Sphere& ball = balls_[i];
        const double reach = (ball.radius + largest_) * rounding + std::abs(ball.center.x) * (rounding - 1);
        auto other = std::lower_bound(by_x_.begin(), by_x_.end(), std::pair{ball.center.x - reach, std::uint32_t{0}});
        std::vector<std::uint32_t> result;
        for (; other != by_x_.end() && other->first <= ball.center.x + reach; ++other) {
            if (other->second != i && meet(ball, balls_[other->second])) {
                result.push_back(other->second);
            }
        }
        std::sort(result.begin(), result.end());
        return result;
    }

private:
    std::span<const Sphere> balls_;
    std::vector<std::pair<double, std::uint32_t>> by_x_;
    double largest_ = 0;
};

/// Returns the caps of ball `i` that others hide; nothing if one contains the whole ball.
std::optional<std::vector<Cap>> caps_of(const Neighbours& neighbours, std::size_t i) {
    const std::span<const Sphere> balls = neighbours.balls();
    const Sphere& ball = balls[i];
    std::vector<Cap> caps;
    for (const std::uint32_t j : neighbours.of(i)) {
        const Sphere& other = balls[j];
        const Vec3 way = other.center - ball.center;
        const double square = squared_norm(way), length = std::sqrt(square);
        if (length + ball.radius <= other.radius) {
            // Of two equal balls the first counts.
            if (!(length + other.radius <= ball.radius) || j < i) {
                return {};
            }
        } else if (length + other.radius > ball.radius) {
            const double sum = ball.radius + other.radius;
            const double height = (square + (ball.radius - other.radius) * sum) / (2 * length * ball.radius);
            caps.push_back({askew(way / length), std::clamp(height, -1.0, 1.0)});
        }
    }
    return caps;
}

/// Returns the caps, the largest first, without those that lie within another: they hide nothing more.
std::vector<Cap> outermost(std::vector<Cap> caps) {
    constexpr double rounding = 1e-9;
    std::stable_sort(caps.begin(), caps.end(), [](const Cap& a, const Cap& b) { return a.height < b.height; });
    std::vector<Cap> result;
    std::vector<double> widths; // of their circles
    for (const Cap& cap : caps) {
        const double width = std::sqrt((1 - cap.height) * (1 + cap.height));
        bool within = false;
        for (std::size_t j = 0; j < result.size() && !within; ++j) {
            // The angle between the axes is at most the difference of the caps' angular radii.
            within = dot(cap.axis, result[j].axis) > cap.height * result[j].height + width * widths[j] + rounding;
        }
        if (!within) {
            result.push_back(cap);
            widths.push_back(width);
        }
    }
    return result;
}

/// Subtracts the arcs of the circle around cap `k` that no cap hides. `hidden`: reused memory.
void subtract_arcs(const std::vector<Cap>& caps, std::size_t k, HeightTable& heights, std::vector<Interval>& hidden,
                   Exposed& part) {
    const Circle circle(caps[k]);
    heights.look(circle);
    hidden.clear();
    for (std::size_t j = 0; j < caps.size(); ++j) {
        if (j != k && !add_hidden(circle, caps[j], heights.of(j), j < k, hidden)) {
            return;
        }
    }
    std::sort(hidden.begin(), hidden.end(),
              [](const Interval& a, const Interval& b) { return a.begin.rank < b.begin.rank; });
    Angle from = first_angle;
    for (const Interval& interval : hidden) {
        if (interval.begin.rank > from.rank) {
            part.subtract(circle, {from, interval.begin});
        }
        if (interval.end.rank > from.rank) {
            from = interval.end;
        }
    }
    if (from.rank < last_angle.rank) {
        part.subtract(circle, {from, last_angle});
    }
}

Exposed exposed_part(std::vector<Cap> all) {
    const std::vector<Cap> caps = outermost(std::move(all));
    Exposed part;
    const Vec3 south{0, 0, -1};
    const bool south_hidden =
        std::any_of(caps.begin(), caps.end(), [&](const Cap& cap) { return dot(south, cap.axis) > cap.height; });
    part.area = south_hidden ? 0 : 4 * pi;
    HeightTable heights(caps);
    std::vector<Interval> hidden;
    for (std::size_t k = 0; k < caps.size(); ++k) {
        subtract_arcs(caps, k, heights, hidden, part);
    }
    return part;
}

std::optional<ExposedPart> part_of(const Neighbours& neighbours, std::size_t i) {
    std::optional<std::vector<Cap>> caps = caps_of(neighbours, i);
    return caps ? std::optional<ExposedPart>(exposed_part(std::move(*caps))) : std::nullopt;
}

} // namespace

UnionParts::UnionParts(std::vector<Sphere> balls) : balls_(std::move(balls)) {
    const Neighbours neighbours(balls_);
    for (std::size_t i = 0; i < balls_.size(); ++i) {
        check_cancelled();
        parts_.push_back(part_of(neighbours, i));
    }
}

UnionParts UnionParts::with(std::vector<Sphere> balls) const {
    UnionParts result;
    result.balls_ = std::move(balls);
    std::vector<Sphere> changed; // before and after the change
    for (std::size_t i = 0; i < std::max(balls_.size(), result.balls_.size()); ++i) {
        const bool was = i < balls_.size(), is = i < result.balls_.size();
        if (was && is && balls_[i] == result.balls_[i]) {
            continue;
        }
        if (was) {
            changed.push_back(balls_[i]);
        }
        if (is) {
            changed.push_back(result.balls_[i]);
        }
    }
    const Neighbours neighbours(result.balls_);
    for (std::size_t i = 0; i < result.balls_.size(); ++i) {
        check_cancelled();
        const Sphere& ball = result.balls_[i];
        const bool kept = i < balls_.size() && balls_[i] == ball &&
                          std::none_of(changed.begin(), changed.end(), [&](const Sphere& s) { return meet(ball, s); });
        result.parts_.push_back(kept ? parts_[i] : part_of(neighbours, i));
    }
    return result;
}

/// `ball`, `part`: of each index.
template <class BallAt, class PartAt> double UnionParts::volume_of(std::size_t count, BallAt ball, PartAt part) {
    Vec3 middle{};
    for (std::size_t i = 0; i < count; ++i) {
        middle += ball(i).center;
    }
    middle = middle / static_cast<double>(std::max<std::size_t>(count, 1));
    double volume = 0;
    for (std::size_t i = 0; i < count; ++i) {
        if (const std::optional<ExposedPart>& shows = part(i)) {
            // V = ⅓ ∮ x · n dA with x = c + r n
            const double r = ball(i).radius;
            volume += r * r * (dot(askew(ball(i).center - middle), shows->normal) + r * shows->area) / 3;
        }
    }
    return volume;
}

double UnionParts::volume() const {
    return volume_of(
        balls_.size(), [&](std::size_t i) -> const Sphere& { return balls_[i]; },
        [&](std::size_t i) -> const std::optional<ExposedPart>& { return parts_[i]; });
}

double UnionParts::volume_with(Split& split) const {
    constexpr std::uint32_t last = UINT32_MAX; // the second ball
    const std::size_t count = balls_.size() + 1;
    std::vector<Sphere> balls; // made on first use
    std::optional<Neighbours> neighbours;
    std::vector<std::pair<std::uint32_t, std::optional<ExposedPart>>> changed;
    auto known = split.known.cbegin();
    const auto need = [&](std::uint32_t name) {
        while (known != split.known.cend() && known->first < name) {
            ++known;
        }
        if (known != split.known.cend() && known->first == name) {
            changed.push_back(*known);
            return;
        }
        if (balls.empty()) {
            balls = balls_;
            balls[split.ball] = split.first;
            balls.push_back(split.second);
            neighbours.emplace(balls);
        }
        changed.emplace_back(name, part_of(*neighbours, name == last ? count - 1 : name));
    };
    const std::array moved{balls_[split.ball], split.first, split.second};
    for (std::uint32_t i = 0; i < balls_.size(); ++i) {
        if (i == split.ball ||
            std::any_of(moved.begin(), moved.end(), [&](const Sphere& s) { return meet(balls_[i], s); })) {
            need(i);
        }
    }
    need(last);
    split.known = std::move(changed);
    auto next = split.known.cbegin();
    return volume_of(
        count,
        [&](std::size_t i) -> const Sphere& {
            return i == split.ball ? split.first : i < balls_.size() ? balls_[i] : split.second;
        },
        [&](std::size_t i) -> const std::optional<ExposedPart>& {
            if (next->first == i || i == balls_.size()) {
                return next++->second;
            }
            return parts_[i];
        });
}

void UnionParts::Split::forget(const UnionParts& now, std::span<const Sphere> changed) {
    std::erase_if(known, [&](const auto& entry) {
        const std::uint32_t i = entry.first;
        const Sphere& own = i == ball ? first : i < now.balls_.size() ? now.balls_[i] : second;
        return std::any_of(changed.begin(), changed.end(), [&](const Sphere& s) { return meet(own, s); });
    });
}

double exact_union_volume(std::span<const Sphere> spheres) {
    std::vector<Sphere> balls;
    std::copy_if(spheres.begin(), spheres.end(), std::back_inserter(balls),
                 [](const Sphere& s) { return is_finite(s.center) && std::isfinite(s.radius) && s.radius > 0; });
    return geometry::UnionParts(std::move(balls)).volume();
}

} // namespace foam::geometry
