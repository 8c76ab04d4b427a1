#include "geometry/crease_cuts.hpp"

#include <bit>

namespace foam::geometry {
namespace {

/// A piece of a triangle in which more creases run than this is left to halving.
constexpr std::uint32_t most_off_middle = 16;
constexpr std::uint32_t all_corners = 7;

const Vec3& corner(const Corners& t, std::size_t k) {
    return k == 0 ? t.a : k == 1 ? t.b : t.c;
}

Vec3 between(const Vec3& a, const Vec3& b, double share) {
    const double rest = 1 - share;
    return a * rest + b * (1 - rest); // the weights add up to 1 exactly (Sterbenz 1974)
}

void cut(Corners& first, Corners& second, std::size_t edge, double share) {
    if (edge == 0) {
        first.b = second.a = between(first.a, first.b, share);
    } else if (edge == 1) {
        first.c = second.b = between(first.b, first.c, share);
    } else {
        second.c = first.a = between(first.c, first.a, share);
    }
}

} // namespace

std::pair<Piece, Piece> cut(const Piece& piece, std::size_t edge, double share) {
    Piece first = piece, second = piece;
    first.level += 2;
    second.level += 2;
    cut(first.corners, second.corners, edge, share);
    if (piece.curved) {
        cut(first.beneath, second.beneath, edge, share);
    }
    return {first, second};
}

bool CreaseCuts::cover(const Piece& piece, std::span<const std::uint32_t> candidates, double smallest) {
    pieces_ = 0;
    most_cuts_ = 0;
    indices_.assign(candidates.begin(), candidates.end());
    waiting_.assign(1, {piece, 0, indices_.size(), 0, 0});
    while (!waiting_.empty()) {
        const Waiting next = waiting_.back();
        waiting_.pop_back();
        indices_.resize(next.end);
        Holders holders;
        const Answer answer = look(next, holders);
        if (answer == Answer::held) {
            continue;
        }
        if (answer == Answer::open || size_of(next.piece) <= smallest || next.piece.level + 2 > most_halvings_ ||
            next.off >= most_off_middle) {
            return false;
        }
        const Crease line = crease(next.piece, holders);
        const std::size_t edge = line.to == (line.from + 1) % 3 ? line.from : line.to;
        const auto [first, second] =
            line.found ? cut(next.piece, edge, edge == line.from ? line.share : 1 - line.share) : halves(next.piece);
        for (const Piece& half : {second, first}) {
            waiting_.push_back({half, next.begin, next.end, next.cuts + 1, next.off + (line.found ? 1 : 0)});
        }
        pieces_ += 2;
        most_cuts_ = std::max(most_cuts_, next.cuts + 1);
    }
    return true;
}

/// Open: a corner is in no ball.
CreaseCuts::Answer CreaseCuts::look(const Waiting& item, Holders& holders) const {
    std::uint32_t corners = 0;
    for (std::size_t k = item.begin; k < item.end; ++k) {
        const std::uint32_t i = indices_[k], held = balls_.corners_held(i, item.piece);
        if (held == all_corners) {
            return Answer::held;
        }
        if (held == 0) {
            continue;
        }
        corners |= held;
        const double growth = reach(balls_.center(i), item.piece) - balls_.radius(i);
        if (growth < holders[held].growth) {
            holders[held] = {i, growth};
        }
    }
    return corners == all_corners ? Answer::undecided : Answer::open;
}

/// Where two balls meet that hold the more of the corners the better, best one of them both; and of such balls those
/// that come nearest to holding all.
CreaseCuts::Crease CreaseCuts::crease(const Piece& piece, const Holders& holders) const {
    Crease best;
    int most = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::uint32_t one = 1; one < all_corners; ++one) {
        for (std::uint32_t other = one + 1; other < all_corners; ++other) {
            const std::uint32_t alone = one & ~other, other_alone = other & ~one;
            const double growth = holders[one].growth + holders[other].growth;
            const int held = std::popcount(one) + std::popcount(other);
            if (alone == 0 || other_alone == 0 || !(growth < std::numeric_limits<double>::infinity()) || held < most ||
                (held == most && growth >= least)) {
                continue;
            }
            const Crease line =
                between(piece, holders[one], holders[other], static_cast<std::size_t>(std::countr_zero(alone)),
                        static_cast<std::size_t>(std::countr_zero(other_alone)));
            if (line.found || held > 2) {
                best = line;
                best.found = true;
                most = held;
                least = growth;
            }
        }
    }
    return best;
}

/// Found: if the balls hold the place, at which their powers are equal.
CreaseCuts::Crease CreaseCuts::between(const Piece& piece, const Holder& first, const Holder& second, std::size_t from,
                                       std::size_t to) const {
    const Vec3 &a = corner(piece.corners, from), &b = corner(piece.corners, to);
    const double before = balls_.power(first.ball, a) - balls_.power(second.ball, a);
    const double after = balls_.power(first.ball, b) - balls_.power(second.ball, b);
    const double share = before / (before - after);
    if (!(share > 0 && share < 1)) {
        return {from, to, 0.5, false};
    }
    return {from, to, share, balls_.power(first.ball, geometry::between(a, b, share)) <= 0};
}

} // namespace foam::geometry
