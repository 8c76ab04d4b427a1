#include "columns.hpp"

#include <foam/base/cancellation.hpp>

#include <algorithm>
#include <numbers>

namespace foam::medial {
namespace {

constexpr int samples_along = 24; ///< points along a column of a solid that is not closed

/// Sorts segments and unites overlapping ones, in place.
void unite(std::vector<Segment>& segments, std::size_t first) {
    const auto begin = segments.begin() + static_cast<std::ptrdiff_t>(first);
    std::sort(begin, segments.end(), [](const Segment& a, const Segment& b) { return a.low < b.low; });
    auto last = begin;
    for (auto it = begin; it != segments.end(); ++it) {
        if (it == begin || it->low > last->high) {
            if (it != begin) {
                ++last;
            }
            *last = *it;
        } else {
            last->high = std::max(last->high, it->high);
        }
    }
    if (begin != segments.end()) {
        segments.erase(last + 1, segments.end());
    }
}

/// Returns the length of [low, high] outside of all segments, which are ascending and disjoint.
double length_outside(double low, double high, std::span<const Segment> segments) {
    double length = high - low;
    for (const Segment& s : segments) {
        if (s.low >= high) {
            break;
        }
        length -= std::max(0.0, std::min(high, s.high) - std::max(low, s.low));
    }
    return std::max(0.0, length);
}

std::vector<Segment> inside_of_open_solid(const Solid& solid, const Frame& frame, double x, double y, double low,
                                          double high) {
    std::vector<Segment> result;
    const double step = (high - low) / samples_along;
    for (int i = 0; i < samples_along; ++i) {
        const double z = low + (i + 0.5) * step;
        if (!solid.contains(frame.to_world({x, y, z}))) {
            continue;
        }
        if (!result.empty() && z - step < result.back().high + step / 4) {
            result.back().high = z + step / 2;
        } else {
            result.push_back({z - step / 2, z + step / 2});
        }
    }
    return result;
}

double ball_volume(double radius) {
    return 4.0 / 3.0 * std::numbers::pi * radius * radius * radius;
}

} // namespace

Columns::Columns(const Shape& shape, const Frame& frame, std::size_t count) {
    // The figures refer to the original geometry. Where it has holes, its repaired form gives the better inside.
    const Solid& solid =
        shape.original().closed() || !shape.processed().closed() ? shape.original() : shape.processed();
    Box box;
    for (const Solid* part : {&solid, &shape.original()}) {
        for (const Vec3& v : part->surface().vertices) {
            box.add(frame.to_local(v));
        }
    }
    const Vec3 size = box.size();
    if (!solid.closed()) {
        count = std::min<std::size_t>(count, 400);
    }
    // Balls about a needle extend far beyond its box: they would meet any number of columns as narrow as the needle.
    const double least = std::max(1.0 / static_cast<double>(count), 1.0 / 400);
    step_ = std::sqrt(std::max(size.x, least) * std::max(size.y, least) / static_cast<double>(count));
    nx_ = std::max(1L, static_cast<long>(std::ceil(size.x / step_)));
    ny_ = std::max(1L, static_cast<long>(std::ceil(size.y / step_)));
    low_x_ = box.center().x - static_cast<double>(nx_) * step_ / 2;
    low_y_ = box.center().y - static_cast<double>(ny_) * step_ / 2;
    offsets_.push_back(0);
    for (long y = 0; y < ny_; ++y) {
        check_cancelled();
        for (long x = 0; x < nx_; ++x) {
            const std::size_t first = segments_.size();
            if (solid.closed()) {
                const Vec3 origin = frame.to_world({center_x(x), center_y(y), 0});
                for (const auto& [enter, leave] : solid.inside_along(origin, frame.axes[2] * frame.scale)) {
                    segments_.push_back({enter, leave});
                }
            } else {
                for (const Segment& s :
                     inside_of_open_solid(solid, frame, center_x(x), center_y(y), box.low.z, box.high.z)) {
                    segments_.push_back(s);
                }
            }
            unite(segments_, first);
            for (std::size_t i = first; i < segments_.size(); ++i) {
                volume_ += (segments_[i].high - segments_[i].low) * step_ * step_;
            }
            offsets_.push_back(static_cast<std::uint32_t>(segments_.size()));
        }
    }
}

std::span<const Segment> Columns::at(long x, long y) const {
    if (x < 0 || x >= nx_ || y < 0 || y >= ny_) {
        return {};
    }
    const std::size_t i = static_cast<std::size_t>(y * nx_ + x);
    return std::span(segments_).subspan(offsets_[i], offsets_[i + 1] - offsets_[i]);
}

bool Columns::inside(const Vec3& p) const {
    for (const Segment& s : at(column_x(p.x), column_y(p.y))) {
        if (p.z >= s.low && p.z <= s.high) {
            return true;
        }
    }
    return false;
}

double Columns::outside(std::span<const Sphere> balls) const {
    Box box;
    for (const Sphere& ball : balls) {
        box.add(ball.center - Vec3{ball.radius, ball.radius, 0});
        box.add(ball.center + Vec3{ball.radius, ball.radius, 0});
    }
    if (box.empty()) {
        return 0;
    }
    double total = 0;
    std::vector<Segment> chords;
    const long x_low = column_x(box.low.x), x_high = column_x(box.high.x);
    for (long y = column_y(box.low.y); y <= column_y(box.high.y); ++y) {
        check_cancelled();
        for (long x = x_low; x <= x_high; ++x) {
            chords.clear();
            for (const Sphere& ball : balls) {
                const double dx = ball.center.x - center_x(x), dy = ball.center.y - center_y(y);
                const double square = ball.radius * ball.radius - dx * dx - dy * dy;
                if (square > 0) {
                    const double half = std::sqrt(square);
                    chords.push_back({ball.center.z - half, ball.center.z + half});
                }
            }
            unite(chords, 0);
            for (const Segment& chord : chords) {
                total += length_outside(chord.low, chord.high, at(x, y));
            }
        }
    }
    return total * step_ * step_;
}

Columns::Free::Free(const Columns& columns, std::span<const Sphere> others, const Vec3& center, double reach)
    : columns_(columns), center_(center), reach_(reach), x_low_(columns.column_x(center.x - reach)),
      x_high_(columns.column_x(center.x + reach)), y_low_(columns.column_y(center.y - reach)),
      y_high_(columns.column_y(center.y + reach)) {
    std::vector<Sphere> near;
    for (const Sphere& other : others) {
        if (std::abs(other.center.x - center.x) < other.radius + reach &&
            std::abs(other.center.y - center.y) < other.radius + reach &&
            std::abs(other.center.z - center.z) < other.radius + reach) {
            near.push_back(other);
        }
    }
    offsets_.push_back(0);
    for (long y = y_low_; y <= y_high_; ++y) {
        for (long x = x_low_; x <= x_high_; ++x) {
            const std::size_t first = segments_.size();
            const auto own = columns.at(x, y);
            segments_.insert(segments_.end(), own.begin(), own.end());
            for (const Sphere& ball : near) {
                const double dx = ball.center.x - columns.center_x(x), dy = ball.center.y - columns.center_y(y);
                const double square = ball.radius * ball.radius - dx * dx - dy * dy;
                if (square > 0) {
                    const double half = std::sqrt(square);
                    segments_.push_back({ball.center.z - half, ball.center.z + half});
                }
            }
            unite(segments_, first);
            offsets_.push_back(static_cast<std::uint32_t>(segments_.size()));
        }
    }
}

double Columns::Free::outside(const Sphere& ball) const {
    const double r = ball.radius;
    for (int axis = 0; axis < 2; ++axis) {
        if (std::abs(ball.center[axis] - center_[axis]) + r > reach_) {
            return std::numeric_limits<double>::infinity();
        }
    }
    double chord_sum = 0, outside_sum = 0;
    const long width = x_high_ - x_low_ + 1;
    const long x_begin = std::max(x_low_, columns_.column_x(ball.center.x - r));
    const long x_end = std::min(x_high_, columns_.column_x(ball.center.x + r));
    const long y_end = std::min(y_high_, columns_.column_y(ball.center.y + r));
    for (long y = std::max(y_low_, columns_.column_y(ball.center.y - r)); y <= y_end; ++y) {
        const double dy = ball.center.y - columns_.center_y(y);
        for (long x = x_begin; x <= x_end; ++x) {
            const double dx = ball.center.x - columns_.center_x(x);
            const double square = r * r - dx * dx - dy * dy;
            if (square > 0) {
                const double half = std::sqrt(square);
                const auto i = static_cast<std::size_t>((y - y_low_) * width + (x - x_low_));
                chord_sum += 2 * half;
                outside_sum += length_outside(ball.center.z - half, ball.center.z + half,
                                              std::span(segments_).subspan(offsets_[i], offsets_[i + 1] - offsets_[i]));
            }
        }
    }
    if (!(chord_sum > 0)) { // between the columns
        return columns_.inside(ball.center) ? 0 : ball_volume(r);
    }
    // The share of the chords times the exact volume: much of the quadrature's error cancels.
    return ball_volume(r) * (outside_sum / chord_sum);
}

} // namespace foam::medial
