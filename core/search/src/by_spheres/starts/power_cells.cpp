#include "by_spheres/starts/power_cells.hpp"

#include "by_spheres/measured/points.hpp"
#include "by_spheres/portfolio/problem.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <utility>

namespace foam::inline search::by_spheres {
namespace {

constexpr unsigned every_edge = 7; ///< of a triangle

double power(const Ball& ball, const Vec3& p) {
    const Vec3 to{p.x - ball.x, p.y - ball.y, p.z - ball.z};
    return squared_norm(to) - static_cast<double>(ball.r) * ball.r;
}

/// Returns the integral of the normal over the area of the exposed surface of ball i; at most a half long. Together
/// with the ball's exposed area it is the direction in which the union grows least; see EnclosingBall.
Vec3 exposed_tilt(const Balls& balls, std::size_t i, const Points& directions, Exposed& exposed) {
    constexpr double longest = 0.5;
    if (!exposed.look(balls, i, directions)) {
        return {};
    }
    float x = 0, y = 0, z = 0, area = 0;
    for (std::size_t k = 0; k < directions.size(); ++k) {
        const float shows = exposed.depth()[k] > 0 ? 1.0f : 0.0f;
        x += shows * directions.x[k];
        y += shows * directions.y[k];
        z += shows * directions.z[k];
        area += shows;
    }
    return tilt_of({x, y, z}, area, longest);
}

} // namespace

/// Finds the least power, and whose it is, for the points from `begin` to `end`.
FOAM_FOR_WIDE_VECTORS
static void find_least_powers(const Points& points, std::size_t begin, std::size_t end, const Rivals& rivals,
                              float* power, std::uint32_t* owner) {
    // Hot loop of the search, vectorised by hand: eight points at a time.
    using Lanes = float __attribute__((vector_size(32)));
    using Names = std::int32_t __attribute__((vector_size(32)));
    constexpr std::size_t lanes = 8;
    constexpr float far = 1e30f;
    const float *bx = rivals.centers.x.data(), *by = rivals.centers.y.data(), *bz = rivals.centers.z.data(),
                *radius = rivals.radius.data();
    const auto load = [](const float* values, Lanes& result) { std::memcpy(&result, values, sizeof result); };
    const std::size_t whole = begin + (end - begin) / lanes * lanes, count = rivals.size();
    for (std::size_t p = begin; p < whole; p += lanes) {
        Lanes x, y, z;
        load(&points.x[p], x);
        load(&points.y[p], y);
        load(&points.z[p], z);
        Lanes least = Lanes{} + far;
        Names who{};
        for (std::size_t i = 0; i < count; ++i) {
            const Lanes dx = x - bx[i], dy = y - by[i], dz = z - bz[i];
            const Lanes here = dx * dx + dy * dy + dz * dz - radius[i] * radius[i];
            const Names nearer = here < least;
            who = (nearer & rivals.index[i]) | (~nearer & who);
            least = here < least ? here : least;
        }
        std::memcpy(&power[p], &least, sizeof least);
        std::memcpy(&owner[p], &who, sizeof who);
    }
    for (std::size_t p = whole; p < end; ++p) {
        power[p] = far;
        owner[p] = 0;
        for (std::size_t i = 0; i < count; ++i) {
            const float dx = points.x[p] - bx[i], dy = points.y[p] - by[i], dz = points.z[p] - bz[i];
            const float here = dx * dx + dy * dy + dz * dz - radius[i] * radius[i];
            if (here < power[p]) {
                power[p] = here;
                owner[p] = static_cast<std::uint32_t>(rivals.index[i]);
            }
        }
    }
}

void Owners::find(const Points& points, const Balls& balls) {
    constexpr std::size_t few = 24; // balls, all of which are compared
    power.resize(points.size());
    owner.resize(points.size());
    const Rivals all = all_rivals(balls);
    if (balls.size() <= few) {
        find_least_powers(points, 0, points.size(), all, power.data(), owner.data());
        return;
    }
    // Consecutive points are often close together: few balls matter to them.
    constexpr std::size_t at_once = 64, many_at_once = 1024;
    RivalSearch search;
    Rivals some, few_of_them;
    for (std::size_t group = 0; group < points.size(); group += many_at_once) {
        const std::size_t group_end = std::min(group + many_at_once, points.size());
        search.find(all, points, group, group_end, some);
        for (std::size_t begin = group; begin < group_end; begin += at_once) {
            const std::size_t end = std::min(begin + at_once, group_end);
            search.find(some, points, begin, end, few_of_them);
            find_least_powers(points, begin, end, few_of_them, power.data(), owner.data());
        }
    }
}

/// Assigns the points to ball `index` where its power is less than that of their owner, or equal and its index is less.
FOAM_FOR_WIDE_VECTORS
static void offer(const Points& points, const Ball& ball, std::uint32_t index, float* power, std::uint32_t* owner) {
    const float *x = points.x.data(), *y = points.y.data(), *z = points.z.data();
    for (std::size_t p = 0; p < points.size(); ++p) {
        const float here = ball.squared_distance(x[p], y[p], z[p]) - ball.r * ball.r;
        const bool taken = (here < power[p]) | ((here == power[p]) & (index < owner[p]));
        power[p] = taken ? here : power[p];
        owner[p] = taken ? index : owner[p];
    }
}

std::vector<std::uint32_t> Owners::update(const Points& points, const Balls& balls, std::size_t one,
                                          std::size_t other) {
    std::vector<std::uint32_t> changed;
    Points lost;
    const auto is_theirs = [&](std::size_t p) { return owner[p] == one || owner[p] == other; };
    for (std::uint32_t p = 0; p < points.size(); ++p) {
        if (is_theirs(p)) {
            changed.push_back(p);
            lost.add(points, p);
            power[p] = -std::numeric_limits<float>::infinity(); // takes no part in what follows
        }
    }
    for (const std::size_t ball : {one, other}) {
        offer(points, balls[ball], static_cast<std::uint32_t>(ball), power.data(), owner.data());
    }
    const std::size_t lost_count = changed.size();
    for (std::uint32_t p = 0; p < points.size(); ++p) {
        if (is_theirs(p) && std::isfinite(power[p])) {
            changed.push_back(p);
        }
    }
    Owners found;
    found.find(lost, balls);
    for (std::size_t k = 0; k < lost_count; ++k) {
        power[changed[k]] = found.power[k];
        owner[changed[k]] = found.owner[k];
    }
    return changed;
}

void PowerCells::find(const Balls& balls, Borders which) {
    owners_.find(skin_.points, balls);
    borders_.clear();
    neighbours_.clear();
    const std::vector<std::uint32_t>& owner = owners_.owner;
    for (std::size_t f = 0; f < skin_.faces.size(); ++f) {
        const auto& face = skin_.faces[f];
        if (owner[face[0]] != owner[face[1]] || owner[face[1]] != owner[face[2]]) {
            if (skin_.fine) {
                cut(face, which == Borders::all ? every_edge : skin_.own_edges[f], balls);
                continue;
            }
            // The cells are convex: a cell that no edge of a needle meets has no relevant part of it.
            for (std::size_t k = 0; k < 3; ++k) {
                cut_edge(face[k], face[(k + 1) % 3], balls);
            }
        }
    }
}

void PowerCells::add_border(const Vec3& point, std::uint32_t a, std::uint32_t b) {
    borders_.add(point);
    neighbours_.push_back({a, b});
}

/// Differences of powers are linear, so their zero follows from the ends.
Vec3 PowerCells::crossing(const Vec3& from, const Vec3& to, const Ball& a, const Ball& b) {
    const double first = power(a, from) - power(b, from), last = power(a, to) - power(b, to);
    const double t = first < last ? std::clamp(-first / (last - first), 0.0, 1.0) : 0.5;
    return from + (to - from) * t;
}

/// Cuts an edge that is long beside the balls and may run through any number of cells. Along it, powers differ by a
/// term linear in its length. The function walks the lower envelope of such lines, each steeper downwards than the one
/// before.
void PowerCells::cut_edge(std::uint32_t from, std::uint32_t to, const Balls& balls) {
    const std::uint32_t last = owners_.owner[to];
    if (owners_.owner[from] == last) {
        return;
    }
    const Vec3 begin = skin_.points.at(from), along = skin_.points.at(to) - begin;
    lines_.clear();
    for (const Ball& ball : balls) {
        lines_.push_back({power(ball, begin), 2 * (along.x * (begin.x - ball.x) + along.y * (begin.y - ball.y) +
                                                   along.z * (begin.z - ball.z))});
    }
    double t = 0;
    for (std::uint32_t cell = owners_.owner[from]; cell != last;) {
        std::uint32_t next = last;
        double soonest = 1;
        for (std::uint32_t i = 0; i < lines_.size(); ++i) {
            const double steeper = lines_[cell][1] - lines_[i][1], above = lines_[i][0] - lines_[cell][0];
            if (steeper > 0 && above < soonest * steeper) {
                soonest = std::max(t, above / steeper);
                next = i;
            }
        }
        add_border(begin + along * soonest, cell, next);
        if (!(lines_[next][1] < lines_[cell][1])) {
            return; // rounding: both powers are equal there
        }
        cell = next;
        t = soonest;
    }
}

void PowerCells::cut(const std::array<std::uint32_t, 3>& face, unsigned own_edges, const Balls& balls) {
    std::array<Vec3, 3> corner;
    std::array<std::uint32_t, 3> cell;
    for (std::size_t k = 0; k < 3; ++k) {
        corner[k] = skin_.points.at(face[k]);
        cell[k] = owners_.owner[face[k]];
    }
    const bool two = cell[0] == cell[1] || cell[1] == cell[2] || cell[2] == cell[0];
    Vec3 middle{};
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t next = (k + 1) % 3;
        if (cell[k] == cell[next] || (two && !(own_edges >> k & 1))) {
            continue;
        }
        const Ball &a = balls[cell[k]], &b = balls[cell[next]];
        const Vec3 border = crossing(corner[k], corner[next], a, b);
        add_border(border, cell[k], cell[next]);
        middle += border / 3;
    }
    if (two) {
        return;
    }
    // Three cells meet. Any interior point can be a corner of all pieces; they are smallest with the point where all
    // three meet.
    std::array<double, 3> first, second;
    for (std::size_t k = 0; k < 3; ++k) {
        const double own = power(balls[cell[0]], corner[k]);
        first[k] = own - power(balls[cell[1]], corner[k]);
        second[k] = own - power(balls[cell[2]], corner[k]);
    }
    const double a = first[1] - first[0], b = first[2] - first[0], c = second[1] - second[0], d = second[2] - second[0];
    const double determinant = a * d - b * c;
    const double s = (second[0] * b - first[0] * d) / determinant, t = (first[0] * c - second[0] * a) / determinant;
    if (s >= 0 && t >= 0 && s + t <= 1) {
        middle = corner[0] + (corner[1] - corner[0]) * s + (corner[2] - corner[0]) * t;
    }
    add_border(middle, cell[0], cell[1]);
    add_border(middle, cell[2], cell[2]);
}

/// Middles of edges lie between other points of a part. Counts first, so that points are written to their final place
/// without reallocation.
void PowerCells::hand_out(std::size_t balls) {
    std::vector<std::size_t> counts(balls);
    const std::size_t all = owners_.owner.size();
    const auto for_each_needed = [&](const auto& visit) {
        for (std::size_t p = 0; p < (skin_.fine ? skin_.middles_begin : all); ++p) {
            visit(p);
        }
        for (std::size_t p = skin_.fine ? skin_.middles_end : all; p < all; ++p) {
            visit(p);
        }
    };
    for_each_needed([&](std::size_t p) { ++counts[owners_.owner[p]]; });
    for (const auto& [a, b] : neighbours_) {
        ++counts[a];
        ++counts[b];
    }
    parts_.resize(balls);
    for (std::size_t i = 0; i < balls; ++i) {
        parts_[i].resize(std::exchange(counts[i], 0));
    }
    const auto give = [&](std::uint32_t ball, const Points& from, std::size_t i) {
        Points& part = parts_[ball];
        const std::size_t place = counts[ball]++;
        part.x[place] = from.x[i];
        part.y[place] = from.y[i];
        part.z[place] = from.z[i];
    };
    for_each_needed([&](std::size_t p) { give(owners_.owner[p], skin_.points, p); });
    for (std::size_t k = 0; k < neighbours_.size(); ++k) {
        give(neighbours_[k].first, borders_, k);
        give(neighbours_[k].second, borders_, k);
    }
}

Balls PowerCells::shared(const Balls& balls) {
    find(balls, Borders::extreme);
    hand_out(balls.size());
    Balls sharers;
    for (std::size_t i = 0; i < balls.size(); ++i) {
        if (parts_[i].size() > 0) {
            std::swap(parts_[sharers.size()], parts_[i]);
            sharers.push_back(balls[i]);
        }
    }
    parts_.resize(sharers.size());
    return sharers;
}

Balls PowerCells::fitted(const Balls& balls, const Points& directions) {
    const Balls sharers = shared(balls);
    Balls fitted;
    for (std::size_t i = 0; i < sharers.size(); ++i) {
        const Vec3 tilt = exposed_tilt(sharers, i, directions, exposed_);
        const Ball& ball = sharers[i];
        fitted.push_back(enclosing_ball_.of(parts_[i], parts_[i].size(), tilt, {ball.x, ball.y, ball.z}));
    }
    return fitted;
}

} // namespace foam::search::by_spheres
