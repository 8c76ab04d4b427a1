#include "proof/body_cuts.hpp"

#include <algorithm>
#include <bit>

namespace foam::inline geometry {
namespace {

constexpr std::uint32_t no_body = 0xFFFFFFFFu;
/// How deep in a polytope it is cut out, in its slack: corners on the cut are inside in spite of rounding.
constexpr double cut_depth = 1.0 / 8;

/// Returns the share of the way from a to b where the value is 0; it has different signs there. Illinois method (Dowell
/// and Jarratt 1971); a linear value takes one step.
template <class Value> double crossing(const Vec3& a, const Vec3& b, double at_a, double at_b, Value value) {
    double low = 0, high = 1, share{};
    enum class End { none, low, high } moved = End::none; // an end that stays twice counts half
    for (int step = 0; step < 8; ++step) {
        share = low + (high - low) * (at_a / (at_a - at_b));
        const double here = value(a * (1 - share) + b * share);
        if (std::abs(here) <= 1e-12 * (std::abs(at_a) + std::abs(at_b))) {
            break;
        }
        if ((here <= 0) == (at_a <= 0)) {
            low = share;
            at_a = here;
            at_b = moved == End::low ? at_b / 2 : at_b;
            moved = End::low;
        } else {
            high = share;
            at_b = here;
            at_a = moved == End::high ? at_a / 2 : at_a;
            moved = End::high;
        }
    }
    return share;
}

} // namespace

template <class Value> bool BodyCuts::split(const Polygon& polygon, Value value, Parts& parts) const {
    if (roundings * (polygon.cuts + 1) > most_halvings_) {
        return false;
    }
    std::array<double, Polygon::most_corners> at;
    for (std::size_t k = 0; k < polygon.corners; ++k) {
        at[k] = value(polygon.corner[k]);
    }
    const auto is_low = [&](std::size_t k) { return at[k] <= 0; };
    parts.low.corners = parts.high.corners = 0;
    int crossings = 0;
    bool whole = true;
    for (std::size_t k = 0; k < polygon.corners; ++k) {
        const std::size_t next = k + 1 == polygon.corners ? 0 : k + 1;
        whole = whole && (is_low(k) ? parts.low : parts.high).add(polygon.corner[k]);
        if (is_low(k) != is_low(next)) {
            const Vec3 &here = polygon.corner[k], &there = polygon.corner[next];
            const double share = crossing(here, there, at[k], at[next], value); // from 0 to 1
            const double rest = 1 - share, taken = 1 - rest; // they add up to exactly 1 (Sterbenz 1974)
            const Vec3 cut = here * rest + there * taken;
            whole = whole && parts.low.add(cut) && parts.high.add(cut);
            ++crossings;
        }
    }
    parts.low.cuts = parts.high.cuts = polygon.cuts + 1;
    return whole && crossings == 2;
}

void BodyCuts::push(Polygon polygon, const Polygon& whole, std::uint32_t without) {
    polygon.begin = indices_.size();
    Box box;
    for (std::size_t k = 0; k < polygon.corners; ++k) {
        box.add(polygon.corner[k]);
    }
    for (std::size_t n = whole.begin; n < whole.end; ++n) {
        const std::uint32_t i = indices_[n];
        if (i != without && overlap(bodies_.bounds(i), box)) {
            indices_.push_back(i);
        }
    }
    polygon.end = indices_.size();
    ++pieces_;
    most_cuts_ = std::max(most_cuts_, polygon.cuts);
    waiting_.push_back(polygon);
}

void BodyCuts::begin(const Corners& triangle, std::span<const std::uint32_t> candidates, std::size_t most_pieces) {
    pieces_ = 0;
    most_cuts_ = 0;
    most_pieces_ = most_pieces;
    indices_.assign(candidates.begin(), candidates.end());
    waiting_.clear();
    waiting_.push_back({.corner = {triangle.a, triangle.b, triangle.c}, .corners = 3, .end = indices_.size()});
}

bool BodyCuts::held(const Polygon& polygon, std::uint32_t body) const {
    return std::all_of(polygon.corner.begin(), polygon.corner.begin() + polygon.corners,
                       [&](const Vec3& p) { return bodies_.holds(body, p); });
}

bool BodyCuts::take(Polygon& next) {
    if (waiting_.empty()) {
        return false;
    }
    asking_.check();
    next = waiting_.back();
    waiting_.pop_back();
    indices_.resize(next.end);
    return true;
}

bool BodyCuts::cover(const Corners& triangle, std::span<const std::uint32_t> candidates, double smallest,
                     std::size_t most_pieces) {
    begin(triangle, candidates, most_pieces);
    smallest_ = smallest;
    Polygon next;
    while (take(next)) {
        if (pieces_ > most_pieces_ || !prove(next)) {
            return false;
        }
    }
    return true;
}

std::vector<std::vector<Vec3>> BodyCuts::rest(const Corners& triangle, std::span<const std::uint32_t> candidates,
                                              std::size_t most_pieces) {
    begin(triangle, candidates, most_pieces);
    std::vector<std::vector<Vec3>> result;
    Polygon next;
    while (take(next)) {
        bool done = false;
        for (std::size_t n = next.begin; n < next.end && !done; ++n) {
            const std::uint32_t i = indices_[n];
            done = held(next, i) || (pieces_ <= most_pieces_ && !bodies_.planes(i).empty() && cut_out(next, i));
        }
        if (!done) {
            result.emplace_back(next.corner.data(), next.corner.data() + next.corners);
        }
    }
    return result;
}

std::vector<Corners> BodyCuts::between(const Corners& triangle, std::uint32_t first, std::uint32_t second) const {
    Polygon whole{.corner = {triangle.a, triangle.b, triangle.c}, .corners = 3};
    Parts parts;
    const auto nearer = [&](const Vec3& p) { return bodies_.growth(first, p) - bodies_.growth(second, p); };
    std::vector<Corners> result;
    if (split(whole, nearer, parts)) {
        for (const Polygon& part : {parts.low, parts.high}) {
            for (std::size_t k = 2; k < part.corners; ++k) {
                result.push_back({part.corner[0], part.corner[k - 1], part.corner[k]});
            }
        }
    }
    return result;
}

std::vector<Corners> BodyCuts::between_nearest(const Corners& triangle, std::span<const std::uint32_t> near) const {
    const std::array<Vec3, 3> corners{triangle.a, triangle.b, triangle.c};
    std::array<std::uint32_t, 3> nearest{};
    std::array<double, 3> least;
    least.fill(std::numeric_limits<double>::infinity());
    for (const std::uint32_t body : near) {
        for (std::size_t c = 0; c < 3; ++c) {
            const double growth = bodies_.growth(body, corners[c]);
            if (growth < least[c]) {
                least[c] = growth;
                nearest[c] = body;
            }
        }
    }
    const std::uint32_t other = nearest[1] != nearest[0] ? nearest[1] : nearest[2];
    return other == nearest[0] ? std::vector<Corners>{} : between(triangle, nearest[0], other);
}

/// Returns false if a corner is in no body, or if the polygon cannot be divided further.
bool BodyCuts::prove(const Polygon& polygon) {
    std::uint32_t together = 0;
    holders_.clear();
    for (std::size_t n = polygon.begin; n < polygon.end; ++n) {
        Holder holder{indices_[n], 0};
        for (std::size_t k = 0; k < polygon.corners; ++k) {
            holder.corners |= static_cast<std::uint32_t>(bodies_.holds(holder.body, polygon.corner[k])) << k;
        }
        if (holder.corners == polygon.all()) {
            return true;
        }
        together |= holder.corners;
        holders_.push_back(holder);
    }
    if (together != polygon.all()) {
        return false;
    }
    std::stable_sort(holders_.begin(), holders_.end(), [](const Holder& a, const Holder& b) {
        return std::popcount(a.corners) > std::popcount(b.corners);
    });
    for (const Holder& holder : holders_) {
        if (!bodies_.planes(holder.body).empty() && cut_out(polygon, holder.body)) {
            return true;
        }
    }
    return held_by_two(polygon) || divide(polygon);
}

/// Returns whether two bodies hold a part of the polygon each. Both are convex: where they hold each edge together, a
/// cut through places of the edges that both hold leaves one part in each of them.
bool BodyCuts::held_by_two(const Polygon& polygon) {
    std::size_t tries = 8;
    Parts parts;
    for (std::size_t i = 0; i < holders_.size(); ++i) {
        for (std::size_t k = i + 1; k < holders_.size(); ++k) {
            const auto [a, corners_of_a] = holders_[i];
            const auto [b, corners_of_b] = holders_[k];
            if ((corners_of_a | corners_of_b) != polygon.all()) {
                continue;
            }
            if (tries-- == 0) {
                return false;
            }
            const auto nearer = [&](const Vec3& p) { return bodies_.depth(a, p) - bodies_.depth(b, p); };
            if (split(polygon, nearer, parts) && held(parts.low, a) && held(parts.high, b)) {
                pieces_ += 2;
                most_cuts_ = std::max(most_cuts_, parts.low.cuts);
                return true;
            }
        }
    }
    return false;
}

/// Cuts a polytope out of the polygon, and queues what is left. Returns false if they do not meet, or if rounding does
/// not allow it.
bool BodyCuts::cut_out(const Polygon& polygon, std::uint32_t polytope) {
    const std::size_t waiting = waiting_.size(), indices = indices_.size(), pieces = pieces_;
    const double depth = bodies_.slack(polytope) * cut_depth;
    const Vec3& center = bodies_.center(polytope);
    Polygon rest = polygon;
    Parts parts;
    bool cut = true;
    for (const Polytope::Face& plane : bodies_.planes(polytope)) {
        const auto above = [&](const Vec3& p) { return dot(plane.normal, p - center) - plane.offset + depth; };
        const auto is_below = [&](const Vec3& p) { return above(p) <= depth * 7 / 8; };
        if (std::all_of(rest.corner.begin(), rest.corner.begin() + rest.corners, is_below)) {
            continue;
        }
        cut = split(rest, above, parts);
        if (!cut) {
            break;
        }
        push(parts.high, polygon, polytope);
        rest.corner = parts.low.corner;
        rest.corners = parts.low.corners;
        rest.cuts = parts.low.cuts;
    }
    cut = cut && held(rest, polytope);
    if (!cut) {
        waiting_.resize(waiting);
        indices_.resize(indices);
        pieces_ = pieces;
    }
    return cut;
}

/// Cuts at half the length. Returns false if the polygon is too small for that.
bool BodyCuts::divide(const Polygon& polygon) {
    std::size_t from = 0, to = 0;
    double longest = -1;
    for (std::size_t i = 0; i < polygon.corners; ++i) {
        for (std::size_t k = i + 1; k < polygon.corners; ++k) {
            const double squared = squared_norm(polygon.corner[i] - polygon.corner[k]);
            if (squared > longest) {
                longest = squared;
                from = i;
                to = k;
            }
        }
    }
    if (!(std::sqrt(longest) > smallest_)) {
        return false;
    }
    Parts parts;
    const Vec3 along = normalized(polygon.corner[to] - polygon.corner[from]);
    const Vec3 middle = polygon.corner[from] + (polygon.corner[to] - polygon.corner[from]) * 0.5;
    const auto beyond = [&](const Vec3& p) { return dot(p - middle, along); };
    if (!split(polygon, beyond, parts)) {
        return false;
    }
    push(parts.high, polygon, no_body);
    push(parts.low, polygon, no_body);
    return true;
}

} // namespace foam::geometry
