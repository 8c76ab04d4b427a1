#include "cells.hpp"
#include "pieces.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/base/parallel.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace foam::inline search::convex {
namespace {

/// Returns the plane half-way between two pieces along the line of their middles.
Plane between(const Piece& a, const Piece& b) {
    const Vec3 ma = mean_of(a.hull), mb = mean_of(b.hull);
    Vec3 normal = normalized(mb - ma);
    if (normal == Vec3{}) {
        normal = {1, 0, 0};
    }
    double top = -std::numeric_limits<double>::infinity(), bottom = -top;
    for (const Vec3& p : a.hull) {
        top = std::max(top, dot(normal, p));
    }
    for (const Vec3& p : b.hull) {
        bottom = std::min(bottom, dot(normal, p));
    }
    return {normal, (top + bottom) / 2};
}

class Recutting {
public:
    Recutting(Partition& partition, const Pricing& pricing, const RecutPlan& plan, std::span<const Plane> faces)
        : partition_(partition), pricing_(pricing), plan_(plan), faces_(faces) {
        changed_.assign(partition.pieces.size(), 1);
    }

    void run() {
        for (int sweep = 0; sweep < plan_.sweeps; ++sweep) {
            const bool moved = recut_neighbours();
            const bool exchanged = exchange();
            if (!moved && !exchanged) {
                break;
            }
        }
    }
    void split_until(std::size_t count) {
        std::vector<Piece>& pieces = partition_.pieces;
        while (pieces.size() < count) {
            find_splits(0);
            std::size_t best = 0;
            for (std::size_t i = 1; i < pieces.size(); ++i) {
                best = gain(pieces[i]) > gain(pieces[best]) ? i : best;
            }
            if (!std::isfinite(pieces[best].split->price)) {
                return;
            }
            Piece a, b;
            apply(pieces[best].bricks, pieces[best].split->plane, a, b);
            if (a.bricks.empty() || b.bricks.empty()) {
                pieces[best].split = Cut{};
                pieces[best].split_gain = -std::numeric_limits<double>::infinity();
                continue;
            }
            pieces[best] = std::move(a);
            pieces.push_back(std::move(b));
        }
    }

private:
    static double gain(const Piece& piece) {
        return piece.split ? piece.split_gain : -std::numeric_limits<double>::infinity();
    }
    /// Looks for the planes that cut each piece in two, where that was not done before and may gain more than `least`:
    /// a cut gains at most what the piece costs.
    void find_splits(double least) {
        parallel_for(partition_.pieces.size(), [&](std::size_t i) {
            Piece& piece = partition_.pieces[i];
            if (!piece.split) {
                check_cancelled();
                const std::array replaced{i};
                const Beside beside = pricing_.beside(partition_.pieces, replaced);
                if (beside.now < least) {
                    return;
                }
                CutSearch search(named(piece.bricks), beside.price);
                const Cut start = search.start(faces_);
                piece.split = std::isfinite(start.price) ? search.improved(start, plan_.split_tries) : start;
                piece.split_gain = beside.now - piece.split->price;
            }
        });
    }
    void apply(const std::vector<std::uint32_t>& members, const Plane& plane, Piece& a, Piece& b) {
        std::vector<std::uint32_t> low, high;
        HullOfPoints hull;
        for (const std::uint32_t i : members) {
            std::array<Brick, 2> parts = cut(hull, partition_.bricks[i], plane);
            if (parts[0].points.empty() || parts[1].points.empty()) {
                (parts[0].points.empty() ? high : low).push_back(i);
                continue;
            }
            low.push_back(i);
            high.push_back(static_cast<std::uint32_t>(partition_.bricks.size()));
            partition_.bricks[i] = std::move(parts[0]);
            partition_.bricks.push_back(std::move(parts[1]));
        }
        std::sort(high.begin(), high.end());
        a = piece_of(partition_.bricks, std::move(low), pricing_);
        b = piece_of(partition_.bricks, std::move(high), pricing_);
    }

    std::vector<const Brick*> named(const std::vector<std::uint32_t>& members) const {
        std::vector<const Brick*> result;
        for (const std::uint32_t i : members) {
            result.push_back(&partition_.bricks[i]);
        }
        return result;
    }
    static std::vector<std::uint32_t> together(const Piece& a, const Piece& b) {
        std::vector<std::uint32_t> members = a.bricks;
        members.insert(members.end(), b.bricks.begin(), b.bricks.end());
        std::sort(members.begin(), members.end());
        return members;
    }
    static bool touch(const Piece& a, const Piece& b) {
        constexpr double near = 1e-6;
        for (int axis = 0; axis < 3; ++axis) {
            if (a.box.low[axis] > b.box.high[axis] + near || b.box.low[axis] > a.box.high[axis] + near) {
                return false;
            }
        }
        return true;
    }
    struct Pair {
        std::uint32_t a, b;
        Cut cut{};
        double gain = 0;
    };
    /// Looks at all pairs at once, then takes the best cuts of pairs that have no piece in common.
    bool recut_neighbours() {
        std::vector<Piece>& pieces = partition_.pieces;
        std::vector<Pair> pairs;
        for (std::uint32_t a = 0; a < pieces.size(); ++a) {
            for (std::uint32_t b = a + 1; b < pieces.size(); ++b) {
                if ((changed_[a] || changed_[b]) && touch(pieces[a], pieces[b])) {
                    pairs.push_back({a, b});
                }
            }
        }
        parallel_for(pairs.size(), [&](std::size_t i) {
            check_cancelled();
            Pair& pair = pairs[i];
            const std::array<std::size_t, 2> replaced{pair.a, pair.b};
            const Beside beside = pricing_.beside(pieces, replaced);
            CutSearch search(named(together(pieces[pair.a], pieces[pair.b])), beside.price);
            const double far = 1.3 * beside.now; // a plane is then far from what separates them
            const Cut start = search.at(between(pieces[pair.a], pieces[pair.b]), far);
            if (start.price < far) {
                pair.cut = search.improved(start, plan_.tries);
                pair.gain = beside.now - pair.cut.price;
            }
        });
        std::stable_sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) { return a.gain > b.gain; });
        std::fill(changed_.begin(), changed_.end(), 0);
        const double least = 1e-5 * partition_.price();
        bool any = false;
        for (const Pair& pair : pairs) {
            if (pair.gain > least && !changed_[pair.a] && !changed_[pair.b]) {
                Piece a, b;
                apply(together(pieces[pair.a], pieces[pair.b]), pair.cut.plane, a, b);
                pieces[pair.a] = std::move(a);
                pieces[pair.b] = std::move(b);
                changed_[pair.a] = changed_[pair.b] = 1;
                any = true;
            }
        }
        return any;
    }
    /// Merges two pieces where that costs less than another piece gains from a cut.
    bool exchange() {
        std::vector<Piece>& pieces = partition_.pieces;
        std::vector<Pair> pairs;
        for (std::uint32_t a = 0; a < pieces.size(); ++a) {
            for (std::uint32_t b = a + 1; b < pieces.size(); ++b) {
                if (touch(pieces[a], pieces[b])) {
                    pairs.push_back({a, b});
                }
            }
        }
        parallel_for(pairs.size(), [&](std::size_t i) {
            check_cancelled();
            Pair& pair = pairs[i];
            std::vector<Vec3> points = pieces[pair.a].hull;
            points.insert(points.end(), pieces[pair.b].hull.begin(), pieces[pair.b].hull.end());
            const std::array<std::size_t, 2> replaced{pair.a, pair.b};
            const Beside beside = pricing_.beside(pieces, replaced);
            pair.gain = beside.now - beside.price(points, {}, std::numeric_limits<double>::infinity());
        });
        std::stable_sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) { return a.gain > b.gain; });
        const double least = 1e-5 * partition_.price();
        if (pairs.empty()) {
            return false;
        }
        find_splits(least - pairs.front().gain);
        std::vector<std::size_t> order(pieces.size());
        for (std::size_t i = 0; i < order.size(); ++i) {
            order[i] = i;
        }
        std::stable_sort(order.begin(), order.end(),
                         [&](std::size_t a, std::size_t b) { return gain(pieces[a]) > gain(pieces[b]); });
        std::vector<char> used(pieces.size(), 0);
        std::size_t next = 0;
        bool any = false;
        for (const Pair& pair : pairs) {
            if (used[pair.a] || used[pair.b]) {
                continue;
            }
            while (next < order.size() && (used[order[next]] || order[next] == pair.a || order[next] == pair.b)) {
                ++next;
            }
            if (next == order.size() || gain(pieces[order[next]]) + pair.gain <= least) {
                break;
            }
            const std::size_t split = order[next];
            pieces[pair.a] = piece_of(partition_.bricks, together(pieces[pair.a], pieces[pair.b]), pricing_);
            Piece a, b;
            apply(pieces[split].bricks, pieces[split].split->plane, a, b);
            pieces[split] = std::move(a);
            pieces[pair.b] = std::move(b);
            used[pair.a] = used[pair.b] = used[split] = 1;
            changed_[pair.a] = changed_[pair.b] = changed_[split] = 1;
            any = true;
        }
        return any;
    }

    Partition& partition_;
    const Pricing& pricing_;
    const RecutPlan plan_;
    const std::span<const Plane> faces_; ///< of the body
    std::vector<char> changed_;
};

} // namespace

void recut(Partition& partition, const Pricing& pricing, const RecutPlan& plan, std::span<const Plane> faces) {
    Recutting(partition, pricing, plan, faces).run();
}

void split_until(Partition& partition, const Pricing& pricing, std::size_t count, const RecutPlan& plan,
                 std::span<const Plane> faces) {
    Recutting(partition, pricing, plan, faces).split_until(count);
}

} // namespace foam::inline search::convex
