#include "proof/crease_cuts.hpp"

#include <foam/base/cancellation.hpp>

namespace foam::inline geometry {

bool CreaseCuts::Polygon::add(const Polygon& from, std::size_t corner) {
    if (corners == most_corners) {
        return false;
    }
    top[corners] = from.top[corner];
    beneath[corners] = from.beneath[corner];
    ++corners;
    return true;
}

bool CreaseCuts::Polygon::add(const Polygon& from, std::size_t corner, double share) {
    if (corners == most_corners) {
        return false;
    }
    const std::size_t next = (corner + 1) % from.corners;
    const double rest = 1 - share, taken = 1 - rest; // they add up to exactly 1 (Sterbenz 1974)
    top[corners] = from.top[corner] * rest + from.top[next] * taken;
    beneath[corners] = from.beneath[corner] * rest + from.beneath[next] * taken;
    ++corners;
    return true;
}

void CreaseCuts::begin(const Piece& piece, std::span<const std::uint32_t> candidates) {
    pieces_ = 0;
    most_cuts_ = 0;
    indices_.assign(candidates.begin(), candidates.end());
    Polygon whole{.top = {piece.corners.a, piece.corners.b, piece.corners.c},
                  .beneath = {piece.beneath.a, piece.beneath.b, piece.beneath.c},
                  .corners = 3,
                  .curved = piece.curved,
                  .end = candidates.size()};
    waiting_.assign(1, whole);
}

CreaseCuts::Polygon CreaseCuts::take() {
    const Polygon next = waiting_.back();
    waiting_.pop_back();
    indices_.resize(next.end);
    return next;
}

template <class Open>
bool CreaseCuts::walk(const Piece& piece, std::span<const std::uint32_t> candidates, Open goes_on_after) {
    begin(piece, candidates);
    CancellationCounter asking(256);
    while (!waiting_.empty()) {
        asking.check();
        const Polygon next = take();
        Pair pair;
        const Answer answer = look(next, pair);
        if (answer == Answer::held || (answer == Answer::divided && cut(next, pair))) {
            continue;
        }
        if (!goes_on_after(next, pair)) {
            return false;
        }
    }
    return true;
}

bool CreaseCuts::cover(const Piece& piece, std::span<const std::uint32_t> candidates) {
    return walk(piece, candidates, [](const Polygon&, const Pair&) { return false; });
}

void CreaseCuts::raise(const Piece& piece, std::span<const std::uint32_t> candidates, std::vector<double>& reach) {
    walk(piece, candidates, [&](const Polygon& open, const Pair& pair) {
        double& farthest = reach[pair.first]; // where rounding separates no two parts, one ball contains both
        for (std::size_t k = 0; k < open.corners; ++k) {
            farthest = std::max(farthest, distance(balls_.center(pair.first), open.top[k]));
            if (open.curved) {
                farthest = std::max(farthest, distance(balls_.center(pair.first), open.beneath[k]));
            }
        }
        return true;
    });
}

/// Returns open if the ball whose power is least at all corners, and so everywhere, does not contain one of them.
CreaseCuts::Answer CreaseCuts::look(const Polygon& polygon, Pair& pair) const {
    std::array<std::uint32_t, Polygon::most_corners> owner{};
    std::array<double, Polygon::most_corners> least;
    least.fill(std::numeric_limits<double>::infinity());
    for (std::size_t n = polygon.begin; n < polygon.end; ++n) {
        const std::uint32_t i = indices_[n];
        bool held = true;
        for (std::size_t k = 0; k < polygon.corners; ++k) {
            const double power = balls_.power(i, polygon.top[k]);
            if (power < least[k]) {
                least[k] = power;
                owner[k] = i;
            }
            held = held && balls_.holds(i, polygon.top[k]) && (!polygon.curved || balls_.holds(i, polygon.beneath[k]));
        }
        if (held) {
            return Answer::held;
        }
    }
    pair = {owner[0], owner[0]};
    for (std::size_t k = 1; k < polygon.corners; ++k) {
        if (owner[k] != owner[0]) {
            pair = {owner[0], owner[k]};
            return Answer::divided;
        }
    }
    return Answer::open;
}

/// Cuts along the plane where the powers of two balls are equal. Returns false if rounding separates no two parts, or
/// after too many cuts.
bool CreaseCuts::cut(const Polygon& polygon, const Pair& pair) {
    constexpr std::uint32_t roundings = 2; // roundings of a cut, in halvings
    if (roundings * (polygon.cuts + 1) > most_halvings_) {
        return false;
    }
    std::array<double, Polygon::most_corners> difference;
    for (std::size_t k = 0; k < polygon.corners; ++k) {
        difference[k] = balls_.power(pair.first, polygon.top[k]) - balls_.power(pair.second, polygon.top[k]);
    }
    Polygon first, second;
    bool whole = true;
    int crossings = 0;
    for (std::size_t k = 0; k < polygon.corners; ++k) {
        const double here = difference[k], next = difference[(k + 1) % polygon.corners];
        whole = whole && (here <= 0 ? first : second).add(polygon, k);
        if ((here <= 0) != (next <= 0)) {
            const double share = here / (here - next);
            whole = whole && share <= 1 && first.add(polygon, k, share) && second.add(polygon, k, share);
            ++crossings;
        }
    }
    if (!whole || crossings != 2) {
        return false;
    }
    push(first, polygon, pair.first, pair.second);
    push(second, polygon, pair.second, pair.first);
    pieces_ += 2;
    most_cuts_ = std::max(most_cuts_, polygon.cuts + 1);
    return true;
}

/// Queues the part of `owner`. There, `owner` need not be compared with `other`, nor with balls whose power is nowhere
/// less.
void CreaseCuts::push(Polygon& polygon, const Polygon& whole, std::uint32_t owner, std::uint32_t other) {
    polygon.curved = whole.curved;
    polygon.cuts = whole.cuts + 1;
    polygon.begin = indices_.size();
    std::array<double, Polygon::most_corners> power;
    for (std::size_t k = 0; k < polygon.corners; ++k) {
        power[k] = balls_.power(owner, polygon.top[k]);
    }
    indices_.push_back(owner);
    for (std::size_t n = whole.begin; n < whole.end; ++n) {
        const std::uint32_t i = indices_[n];
        bool less = false;
        for (std::size_t k = 0; k < polygon.corners && !less; ++k) {
            less = balls_.power(i, polygon.top[k]) < power[k];
        }
        if (less && i != other) {
            indices_.push_back(i);
        }
    }
    polygon.end = indices_.size();
    waiting_.push_back(polygon);
}

} // namespace foam::geometry
