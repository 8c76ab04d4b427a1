#include "proof/ball_tops.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace foam::inline geometry {

BallTops::BallTops(std::vector<Vec3> centers, std::vector<double> radii, const Vec3& up)
    : centers_(std::move(centers)), radii_(std::move(radii)), up_(up) {
    constexpr double rounding = 1e-14; // some fifty roundings
    double reach = 0;
    for (std::size_t i = 0; i < centers_.size(); ++i) {
        reach = std::max(reach, norm(centers_[i]) + radii_[i]);
    }
    squared_error_ = rounding * reach * reach;
}

bool BallTops::of(std::uint32_t i, std::vector<BallTop>& tops) {
    tops.clear();
    if (!find_near(i)) {
        return false;
    }
    for (const std::uint32_t j : near_) {
        if (j < i) {
            continue;
        }
        const Vec3 between = centers_[j] - centers_[i];
        const double squared = squared_norm(between), length = std::sqrt(squared);
        const double along = (squared + radii_[i] * radii_[i] - radii_[j] * radii_[j]) / (2 * length);
        const double left = radii_[i] * radii_[i] - along * along;
        constexpr double narrow = 1e-6; // balls that only just meet
        if (!(left > narrow * radii_[i] * radii_[i]) || squared <= 1e6 * squared_error_) {
            return false;
        }
        const Circle circle{i, j, centers_[i] + between * (along / length), between / length, std::sqrt(left)};
        if (find_crossed(circle)) {
            continue;
        }
        for (const std::uint32_t k : crossed_) {
            if (k > j && !add_tops(circle, k, tops)) {
                return false;
            }
        }
    }
    return true;
}

/// Sets near_ to the balls whose surfaces meet that of ball i; empty if another ball holds it. Returns false if that is
/// in doubt.
bool BallTops::find_near(std::uint32_t i) {
    near_.clear();
    for (std::uint32_t j = 0; j < centers_.size(); ++j) {
        const double squared = squared_norm(centers_[j] - centers_[i]);
        const double sum = radii_[i] + radii_[j], difference = radii_[j] - radii_[i];
        if (j == i || radii_[j] == 0 || squared > sum * sum + squared_error_) {
            continue;
        }
        if (squared > difference * difference + squared_error_) {
            near_.push_back(j);
        } else if (squared > difference * difference - squared_error_) {
            return false;
        } else if (difference > 0) {
            near_.clear();
            return true;
        }
    }
    return true;
}

bool BallTops::find_crossed(const Circle& circle) {
    crossed_.clear();
    for (const std::uint32_t k : near_) {
        if (k == circle.j) {
            continue;
        }
        const Vec3 to = centers_[k] - circle.middle;
        const double height = dot(to, circle.axis), squared = squared_norm(to) - height * height;
        const double aside = std::sqrt(std::max(0.0, squared)), limit = radii_[k] * radii_[k] - height * height;
        const double near = circle.radius - aside, far = circle.radius + aside;
        // The radius of the circle is known to squared_error / radius.
        const double error = squared_error_ * (4 + aside / circle.radius);
        if (far * far < limit - error) {
            return true;
        }
        if (near * near <= limit + error) {
            crossed_.push_back(k);
        }
    }
    return false;
}

bool BallTops::add_tops(const Circle& circle, std::uint32_t k, std::vector<BallTop>& tops) const {
    const Vec3 to = centers_[k] - circle.middle;
    const double height = dot(to, circle.axis);
    const Vec3 aside = to - circle.axis * height;
    const double length = norm(aside);
    const double twice = 2 * circle.radius * length;
    const double error = squared_error_ * (4 + length / circle.radius);
    constexpr double vague = 1e-4;
    if (!(error < vague * twice)) {
        return false;
    }
    const double cosine =
        (circle.radius * circle.radius + length * length + height * height - radii_[k] * radii_[k]) / twice;
    const double off = error / twice; // of the cosine
    if (std::abs(cosine) > 1 + off) {
        return true;
    }
    const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
    const double turned = 2 * (sine > 2 * std::sqrt(off) ? off / sine : std::sqrt(2 * off) + sine);
    const double reach = circle.radius * turned + 4 * squared_error_ / circle.radius;
    const Vec3 x = aside * (circle.radius * cosine / length);
    const Vec3 y = cross(circle.axis, aside) * (circle.radius * sine / length);
    return add_top(circle, k, circle.middle + x + y, reach, tops) &&
           add_top(circle, k, circle.middle + x - y, reach, tops);
}

/// Adds a point where three balls meet, unless it is inside another one or a way leads up. A way leads up unless the
/// opposite of up is a sum of the normals with positive weights (Farkas).
bool BallTops::add_top(const Circle& circle, std::uint32_t k, const Vec3& p, double error,
                       std::vector<BallTop>& tops) const {
    bool alone = true; // no fourth ball there
    for (const std::uint32_t m : near_) {
        if (m == circle.j || m == k) {
            continue;
        }
        const double squared = squared_norm(p - centers_[m]), r = radii_[m];
        const double room = 2 * error * (r + error) + squared_error_;
        if (squared < r * r - room) {
            return true;
        }
        alone = alone && squared > r * r + room;
    }
    std::array<Vec3, 3> normals;
    const std::array<std::uint32_t, 3> balls{circle.i, circle.j, k};
    double least = radii_[k];
    for (std::size_t n = 0; n < 3; ++n) {
        normals[n] = (p - centers_[balls[n]]) / radii_[balls[n]];
        least = std::min(least, radii_[balls[n]]);
    }
    const Vec3 across = cross(normals[0], normals[1]);
    const double volume = dot(across, normals[2]);
    const std::array<double, 3> shares{-dot(up_, cross(normals[1], normals[2])),
                                       -dot(up_, cross(normals[2], normals[0])), -dot(up_, across)};
    const double doubt = 16 * error / least + 1e-12;
    if (alone && std::abs(volume) > doubt && std::any_of(shares.begin(), shares.end(), [&](double share) {
            return (volume > 0 ? share : -share) < -doubt;
        })) {
        return true;
    }
    tops.push_back({p, error});
    return true;
}

} // namespace foam::inline geometry
