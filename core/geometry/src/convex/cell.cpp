#include <foam/base/cancellation.hpp>
#include <foam/geometry/cell.hpp>

#include <algorithm>
#include <cmath>

namespace foam::inline geometry {
namespace {

constexpr double on_plane = 1e-9; // of the solid's diagonal: nearer points count as lying in a cutting plane

/// Returns twice the area of a polygon as seen along an axis, positive if its normal points along it.
double facing(const Vec3* points, std::size_t count, int axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    double sum = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3 a = points[i] - points[0], b = points[(i + 1) % count] - points[0];
        sum += a[u] * b[v] - a[v] * b[u];
    }
    return sum;
}

} // namespace

Cell::Cell(const Solid& solid, const std::array<Vec3, 3>& axes, Content content)
    : solid_(&solid), axes_(axes), middle_(solid.bounds().center()), content_(content) {}
Cell::Cell(const Cell&) = default;
Cell::Cell(Cell&&) noexcept = default;
Cell& Cell::operator=(const Cell&) = default;
Cell& Cell::operator=(Cell&&) noexcept = default;
Cell::~Cell() = default;

Cell Cell::whole(const Solid& solid, const std::array<Vec3, 3>& axes, Content content) {
    Cell cell(solid, axes, content);
    const Mesh& surface = solid.surface();
    cell.points_.reserve(3 * surface.triangles.size());
    cell.ends_.reserve(surface.triangles.size());
    for (const Triangle& triangle : surface.triangles) {
        std::array<Vec3, 3> corners;
        for (int k = 0; k < 3; ++k) {
            const Vec3 p = surface.vertices[triangle[k]] - cell.middle_;
            corners[k] = {dot(axes[0], p), dot(axes[1], p), dot(axes[2], p)};
            cell.box_.add(corners[k]);
        }
        cell.add_polygon(corners.data(), 3);
    }
    return cell;
}

void Cell::add_polygon(const Vec3* points, std::size_t count) {
    points_.insert(points_.end(), points, points + count);
    ends_.push_back(static_cast<std::uint32_t>(points_.size()));
}

Cell Cell::empty_copy(const Box& box) const {
    Cell cell(*solid_, axes_, content_);
    cell.box_ = box;
    return cell;
}

Cell Cell::in_box(const Box& box) const {
    Cell cell = *this;
    cell.box_ = box;
    return cell;
}

Cell Cell::turned(const std::array<Vec3, 3>& axes) const {
    Cell cell(*solid_, axes, content_);
    cell.ends_ = ends_;
    cell.points_.reserve(points_.size());
    for (const Vec3& point : points_) {
        const Vec3 p = point.x * axes_[0] + point.y * axes_[1] + point.z * axes_[2];
        cell.points_.push_back({dot(axes[0], p), dot(axes[1], p), dot(axes[2], p)});
        cell.box_.add(cell.points_.back());
    }
    return cell;
}

Cell Cell::coarse(double size) const {
    using Cube = std::array<std::int64_t, 3>;
    std::vector<std::pair<Cube, std::size_t>> small; // cubes, each with one of its points
    Cell cell = empty_copy(box_);
    std::size_t begin = 0;
    for (const std::size_t end : ends_) {
        Box bounds;
        for (std::size_t i = begin; i < end; ++i) {
            bounds.add(points_[i]);
        }
        if (bounds.diagonal() > size) {
            cell.add_polygon(points_.data() + begin, end - begin);
        } else {
            for (std::size_t i = begin; i < end; ++i) {
                Cube cube;
                for (int axis = 0; axis < 3; ++axis) {
                    cube[static_cast<std::size_t>(axis)] = std::llround((points_[i][axis] - box_.low[axis]) / size);
                }
                small.emplace_back(cube, i);
            }
        }
        begin = end;
    }
    std::sort(small.begin(), small.end());
    for (std::size_t k = 0; k < small.size(); ++k) {
        if (k == 0 || small[k].first != small[k - 1].first) {
            cell.add_polygon(&points_[small[k].second], 1);
        }
    }
    return cell;
}

Vec3 Cell::to_solid(const Vec3& local) const {
    return middle_ + local.x * axes_[0] + local.y * axes_[1] + local.z * axes_[2];
}

void Cell::cut_polygon(const Vec3* points, std::size_t count, int axis, double value, Cell& low, Cell& high) const {
    const double tolerance = on_plane * solid_->bounds().diagonal();
    const auto side = [&](const Vec3& p) {
        const double offset = p[axis] - value;
        return offset > tolerance ? 1 : offset < -tolerance ? -1 : 0;
    };
    int least = 1, most = -1;
    for (std::size_t i = 0; i < count; ++i) {
        least = std::min(least, side(points[i]));
        most = std::max(most, side(points[i]));
    }
    if (least == 0 && most == 0) {
        (facing(points, count, axis) < 0 ? high : low).add_polygon(points, count);
        return;
    }
    if (most <= 0 || least >= 0) {
        (most <= 0 ? low : high).add_polygon(points, count);
        return;
    }
    // Computes both halves as Sutherland and Hodgman 1974; the new points lie exactly in the plane and are shared.
    std::vector<Vec3> below, above;
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3 &p = points[i], &q = points[(i + 1) % count];
        const int here = side(p), next = side(q);
        if (here <= 0) {
            below.push_back(p);
        }
        if (here >= 0) {
            above.push_back(p);
        }
        if (here * next < 0) {
            Vec3 crossing = p + (q - p) * ((value - p[axis]) / (q[axis] - p[axis]));
            crossing[axis] = value;
            below.push_back(crossing);
            above.push_back(crossing);
        }
    }
    low.add_polygon(below.data(), below.size());
    high.add_polygon(above.data(), above.size());
}

std::pair<Cell, Cell> Cell::cut(int axis, double value) const {
    Box lower = box_, upper = box_;
    lower.high[axis] = value;
    upper.low[axis] = value;
    std::pair<Cell, Cell> halves{empty_copy(lower), empty_copy(upper)};
    std::size_t begin = 0;
    for (const std::uint32_t end : ends_) {
        cut_polygon(points_.data() + begin, end - begin, axis, value, halves.first, halves.second);
        begin = end;
    }
    return halves;
}

/// Appends `count` slices of `cell` across `axis`, halving the number recursively: O(polygons · log count).
void Cell::divide(Cell&& cell, int axis, int count, std::vector<Cell>& slices) {
    if (count == 1) {
        slices.push_back(std::move(cell));
        return;
    }
    const int below = count / 2;
    const double share = static_cast<double>(below) / count;
    auto halves = cell.cut(axis, cell.box_.low[axis] + share * (cell.box_.high[axis] - cell.box_.low[axis]));
    divide(std::move(halves.first), axis, below, slices);
    divide(std::move(halves.second), axis, count - below, slices);
}

bool Cell::holds_something() const {
    // Without surface, a cell is inside or outside as a whole.
    return at_surface() || (content_ == Content::solid && solid_->contains(to_solid(box_.center())));
}

std::vector<Cell> Cell::divided(const std::array<int, 3>& counts) const {
    std::vector<Cell> cells{*this};
    for (const int axis : {2, 1, 0}) {
        std::vector<Cell> slices;
        for (Cell& cell : cells) {
            divide(std::move(cell), axis, counts[static_cast<std::size_t>(axis)], slices);
        }
        cells = std::move(slices);
    }
    std::erase_if(cells, [](const Cell& cell) { return !cell.holds_something(); });
    return cells;
}

/// Returns the box's corners that are inside the solid and not in the ball `known`. It tests points just inside the
/// box: a corner that only touches a neighbour's part does not count.
std::vector<Vec3> Cell::inside_corners(const Sphere& known) const {
    std::vector<Vec3> corners;
    if (content_ == Content::surface) {
        return corners;
    }
    const Vec3 center = box_.center();
    for (int i = 0; i < 8; ++i) {
        const Vec3 corner{i & 1 ? box_.high.x : box_.low.x, i & 2 ? box_.high.y : box_.low.y,
                          i & 4 ? box_.high.z : box_.low.z};
        if (distance(corner, known.center) > known.radius &&
            solid_->contains(to_solid(corner + (center - corner) * 1e-6))) {
            corners.push_back(corner);
        }
    }
    return corners;
}

Box Cell::extent() const {
    Box extent;
    for (const Vec3& point : points_) {
        extent.add(point);
    }
    for (const Vec3& corner : inside_corners({extent.center(), -1})) {
        extent.add(corner);
    }
    // A sliver beside the surface, thinner than rounding: its middle is inside, but not its corners.
    return extent.empty() ? box_ : extent;
}

Sphere Cell::ball() const {
    Sphere ball{box_.center(), -1};
    if (!points_.empty()) {
        ball = minimum_enclosing_sphere(points_);
    }
    const std::vector<Vec3> corners = inside_corners(ball);
    if (!corners.empty()) {
        std::vector<Vec3> all = points_;
        all.insert(all.end(), corners.begin(), corners.end());
        ball = minimum_enclosing_sphere(all);
    }
    // Where two balls only just meet on a cut, a proof by subdivision would cut very finely. A small overlap prevents
    // that.
    constexpr double overlap = 1e-5;
    const double least = std::max(1e-9 * solid_->bounds().diagonal(), 1e-300);
    return {to_solid(ball.center), std::max(ball.radius * (1 + overlap), least)};
}

std::optional<Sphere> Cell::inner_ball() const {
    const auto depth = [&](const Vec3& local) { return -solid_->signed_distance(to_solid(local)); };
    constexpr int samples = 3;
    Vec3 best = box_.center();
    double deepest = depth(best);
    const Vec3 size = box_.size();
    for (int i = 0; i < samples * samples * samples; ++i) {
        const Vec3 at{(i % samples + 0.5) / samples, (i / samples % samples + 0.5) / samples,
                      (i / samples / samples + 0.5) / samples};
        const Vec3 point = box_.low + Vec3{at.x * size.x, at.y * size.y, at.z * size.z};
        if (const double d = depth(point); d > deepest) {
            deepest = d;
            best = point;
        }
    }
    for (double step = 0.25; step > 1e-3;) {
        bool moved = false;
        for (int direction = 0; direction < 6; ++direction) {
            const int axis = direction / 2;
            Vec3 point = best;
            point[axis] =
                std::clamp(point[axis] + (direction % 2 ? step : -step) * size[axis], box_.low[axis], box_.high[axis]);
            if (const double d = depth(point); d > deepest) {
                deepest = d;
                best = point;
                moved = true;
            }
        }
        if (!moved) {
            step /= 2;
        }
    }
    const double rounding = 1e-12 * (norm(middle_) + solid_->bounds().diagonal());
    if (!(deepest > rounding)) {
        return std::nullopt;
    }
    return Sphere{to_solid(best), deepest - rounding};
}

} // namespace foam::geometry
