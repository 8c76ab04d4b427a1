#include "fit_programme.hpp"
#include "least_fit.hpp"
#include "plane.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/geometry/vector.hpp>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <optional>

namespace foam::inline search::convex {
namespace {

using Axes = std::array<Vec3, 3>;

/// Axes with the volume of the box along them, in cubic units.
struct Oriented {
    Axes axes;
    double volume;
};

/// Returns the extents of the points along an axis, at least as thick as an element must be.
double extent(const Cloud& cloud, const Vec3& axis) {
    double low = dot(axis, cloud.points.front()), high = low;
    for (const Vec3& p : cloud.points) {
        const double t = dot(axis, p);
        low = std::min(low, t);
        high = std::max(high, t);
    }
    return std::max(high - low, 2 * thin);
}

/// Boxes around the points, turned to better orientations.
class TurnedBoxes {
public:
    explicit TurnedBoxes(const Cloud& cloud) : cloud_(cloud) {}

    Oriented as_is(const Axes& axes) const {
        return {axes, extent(cloud_, axes[0]) * extent(cloud_, axes[1]) * extent(cloud_, axes[2])};
    }
    /// Returns the least box with an axis along `z`.
    Oriented about(const Vec3& z) {
        const Axes frame = frame_along(z);
        flat_.clear();
        for (const Vec3& p : cloud_.points) {
            flat_.push_back({dot(frame[0], p), dot(frame[1], p)});
        }
        const Rectangle rectangle = least_rectangle(flat_, 2 * thin);
        const Vec3 x = normalized(frame[0] * rectangle.along.x + frame[1] * rectangle.along.y);
        return {{x, cross(z, x), z}, rectangle.area * extent(cloud_, z)};
    }
    Oriented descended(Oriented best, Effort effort) {
        // Around balls each step gains less than the one before, and never nothing.
        const double least_gain = effort == Effort::fast ? 1e-4 : 1e-7;
        constexpr std::size_t most_steps = 300;
        int idle = 0;
        for (std::size_t step = 0; idle < 3 && step < most_steps; ++step) {
            check_cancelled();
            const Oriented next = about(best.axes[step % 3]);
            idle = next.volume < best.volume * (1 - least_gain) ? 0 : idle + 1;
            if (next.volume < best.volume) {
                best = next;
            }
        }
        return best;
    }

private:
    const Cloud& cloud_;
    std::vector<Vec2> flat_;
};

Axes principal_axes_of(const std::vector<Vec3>& points) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
    for (const Vec3& p : points) {
        const Eigen::Vector3d v(p.x, p.y, p.z);
        sum += v;
        squares += v * v.transpose();
    }
    const double n = static_cast<double>(points.size());
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(squares / n - sum * sum.transpose() / (n * n));
    const auto column = [&](int i) {
        const Eigen::Vector3d v = solver.eigenvectors().col(i);
        return normalized(Vec3{v.x(), v.y(), v.z()});
    };
    const Vec3 x = column(2), y = column(1);
    return {x, y, cross(x, y)};
}

} // namespace

Fit box_along(const Cloud& cloud, const Axes& axes) {
    Fit fit{.kind = Element::Kind::box, .axes = axes};
    Box box;
    for (const Vec3& p : cloud.points) {
        box.add(Vec3{dot(axes[0], p), dot(axes[1], p), dot(axes[2], p)});
    }
    fit.center = fit.outside(box.center());
    const Vec3 size = box.size() * 0.5;
    fit.half = {std::max(size.x, thin), std::max(size.y, thin), std::max(size.z, thin)};
    return fit;
}

Fit quick_box(const Cloud& cloud) {
    TurnedBoxes search(cloud);
    Oriented best = search.as_is(principal_axes_of(cloud.points));
    for (const Vec3& axis : Axes(best.axes)) {
        if (const Oriented found = search.about(axis); found.volume < best.volume) {
            best = found;
        }
    }
    for (const Vec3& normal : cloud.normals) {
        if (const Oriented found = search.about(normal); found.volume < best.volume) {
            best = found;
        }
    }
    return box_along(cloud, best.axes);
}

/// Returns boxes of little volume, the least first.
static std::vector<Oriented> boxes_from(const Cloud& cloud, const std::vector<Vec3>& normals, Effort effort) {
    TurnedBoxes search(cloud);
    std::vector<Oriented> boxes{search.as_is({Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}),
                                search.as_is(principal_axes_of(cloud.points))};
    const std::size_t flush = effort == Effort::fast ? 12 : effort == Effort::normal ? 40 : 200;
    for (std::size_t i = 0; i < std::min(flush, normals.size()); ++i) {
        check_cancelled();
        boxes.push_back(search.about(normals[i]));
    }
    const std::size_t spread = effort == Effort::fast ? 8 : effort == Effort::normal ? 24 : 200;
    for (const Vec3& direction : fibonacci_directions(2 * spread)) {
        check_cancelled();
        if (direction.z >= 0) {
            boxes.push_back(search.about(direction));
        }
    }
    const auto less = [](const Oriented& a, const Oriented& b) { return a.volume < b.volume; };
    std::stable_sort(boxes.begin(), boxes.end(), less);
    const std::size_t descents = effort == Effort::fast ? 3 : effort == Effort::normal ? 10 : boxes.size();
    boxes.resize(std::min(descents, boxes.size()));
    for (Oriented& box : boxes) {
        check_cancelled();
        box = search.descended(box, effort);
    }
    std::stable_sort(boxes.begin(), boxes.end(), less);
    return boxes;
}

Fit least_box(const Cloud& cloud, Effort effort) {
    // Of many points, the extreme ones tell which boxes are worth a look at all.
    Cloud coarse;
    coarse.points = effort == Effort::fast ? few_extremes_of(cloud.points) : extremes_of(cloud.points);
    const std::vector<Oriented> found = boxes_from(coarse, cloud.normals, effort);
    if (coarse.points.size() == cloud.points.size()) {
        return box_along(cloud, found.front().axes);
    }
    if (effort == Effort::fast) {
        constexpr double near = 0.02; // units
        const Fit first = box_along(cloud, found.front().axes);
        const Cloud boundary = near_boundary(first, cloud, near);
        TurnedBoxes search(boundary);
        const Fit box = box_along(cloud, search.descended(search.as_is(found.front().axes), effort).axes);
        return volume(box) < volume(first) ? box : first;
    }
    const std::size_t looks = effort == Effort::normal ? 6 : found.size();
    TurnedBoxes search(cloud);
    std::optional<Oriented> best;
    for (std::size_t i = 0; i < std::min(looks, found.size()); ++i) {
        const Oriented box = search.descended(search.as_is(found[i].axes), effort);
        if (!best || box.volume < best->volume * (1 - 1e-9)) {
            best = box;
        }
    }
    return box_along(cloud, best->axes);
}

} // namespace foam::inline search::convex
