// Growth until everything is covered: by the worst gap first, or by power cells.
#include "proof/growth.hpp"

#include "proof/crease_cuts.hpp"
#include "measure/exposure.hpp"
#include "proof/filling.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/base/error.hpp>
#include <foam/geometry/internal/proof.hpp>
#include <foam/geometry/measure.hpp>

#include <algorithm>
#include <memory>
#include <queue>

namespace foam::inline geometry {
namespace {

/// Share of the growth for the whole piece that an uncovered corner needs at least, so that one ball gets the piece.
constexpr double fine_enough = 0.8;
/// Number of nearest balls that are compared by the excess volume they would add.
constexpr std::size_t compared = 4;

/// Growth by best-first search. The queue's keys are upper bounds of the pieces' gaps, as balls only grow.
class Growth {
public:
    Growth(const Solid& solid, std::vector<Sphere>& spheres)
        : spheres_(spheres), balls_(solid, spheres, growth_halvings, growth_caution), cost_(solid, spheres.size()) {}

    /// Returns false once it has examined more than `most_looks` pieces: some may then be uncovered.
    bool run(std::size_t most_looks) {
        std::vector<char> held(balls_.round_parts().empty() ? 0 : balls_.piece_count(), 0);
        for (const RoundPart& part : balls_.round_parts()) {
            close_round_part(part);
            std::fill(held.begin() + part.begin, held.begin() + part.end, balls_.held(part));
        }
        for (const std::uint32_t i : balls_.open_triangles()) {
            if (held.empty() || !held[i]) {
                asking_.check();
                const Piece piece = balls_.piece(i);
                enqueue(piece, near(piece));
            }
        }
        for (std::size_t looks = 0; !queue_.empty(); ++looks) {
            if (looks == most_looks) {
                return false;
            }
            asking_.check();
            const Entry entry = queue_.top();
            queue_.pop();
            const Bounds now = bounds(entry.piece, *entry.near);
            if (now.held) {
                continue;
            }
            if (now.upper < entry.gap && !queue_.empty() && now.upper < queue_.top().gap) {
                queue_.push({now.upper, made_++, entry.piece, entry.near}); // other pieces are worse by now
                continue;
            }
            const bool small =
                size_of(entry.piece) <= smallest_grown_piece * balls_.extent() || entry.piece.level >= growth_halvings;
            if (small || now.lower >= fine_enough * now.upper) {
                give(entry.piece);
                continue;
            }
            const auto [first, second] = halves(entry.piece);
            enqueue(first, near(first, entry.near));
            enqueue(second, near(second, entry.near));
        }
        return true;
    }

private:
    /// The balls that may be nearest to a point of a piece or contain it; its parts have no others.
    struct Near {
        Vec3 middle;
        double limit; // a ball whose gap at the middle is larger does not matter
        std::vector<std::uint32_t> balls;
        std::size_t growths = 0; // that are taken into account
    };
    struct Entry {
        double gap;
        std::uint64_t number; // creation number: equal gaps are processed in order
        Piece piece;
        std::shared_ptr<Near> near;
        bool operator<(const Entry& other) const { return gap != other.gap ? gap < other.gap : number > other.number; }
    };
    struct Bounds {
        bool held;
        double lower, upper; // bounds of the gap
    };

    void enqueue(const Piece& piece, std::shared_ptr<Near> near) {
        const Bounds b = bounds(piece, *near);
        if (!b.held) {
            queue_.push({b.upper, made_++, piece, std::move(near)});
        }
    }

    std::shared_ptr<Near> near(const Piece& piece) {
        auto result = std::make_shared<Near>();
        result->limit = balls_.candidates(piece, result->balls);
        result->middle = middle_of(piece).point;
        result->growths = grown_.size();
        return result;
    }

    /// Returns those of a part of a piece: those of the whole if they are few.
    std::shared_ptr<Near> near(const Piece& piece, const std::shared_ptr<Near>& of_whole) {
        constexpr std::size_t few = 12;
        update(*of_whole);
        if (of_whole->balls.size() <= few) {
            return of_whole;
        }
        auto result = std::make_shared<Near>();
        const std::size_t count = of_whole->balls.size();
        scratch_ = of_whole->balls;
        result->limit = balls_.candidates(piece, 0, count, scratch_);
        result->balls.assign(scratch_.begin() + static_cast<std::ptrdiff_t>(count), scratch_.end());
        result->middle = middle_of(piece).point;
        result->growths = grown_.size();
        return result;
    }

    /// Adds the balls that have grown near. What is nearest is not farther than before.
    void update(Near& near) const {
        for (; near.growths < grown_.size(); ++near.growths) {
            const std::uint32_t i = grown_[near.growths];
            if (balls_.gap(i, near.middle) <= near.limit &&
                std::find(near.balls.begin(), near.balls.end(), i) == near.balls.end()) {
                near.balls.push_back(i);
            }
        }
    }

    /// Grows a ball to contain the part if that takes less than the protrusion of the part's tessellation.
    void close_round_part(const RoundPart& part) {
        constexpr double tessellation = 0.005;
        double least = tessellation * part.radius;
        std::uint32_t best = 0;
        double best_radius = 0;
        for (std::uint32_t i = 0; i < balls_.size(); ++i) {
            const double radius = balls_.radius_around(i, part);
            if (std::isfinite(balls_.radius(i)) && radius - spheres_[i].radius < least) {
                least = radius - spheres_[i].radius;
                best = i;
                best_radius = radius;
            }
        }
        if (best_radius > spheres_[best].radius) {
            spheres_[best].radius = best_radius;
            balls_.set_radius(best, best_radius);
        }
    }

    Bounds bounds(const Piece& piece, Near& near) {
        update(near);
        constexpr double infinity = std::numeric_limits<double>::infinity();
        const PiecePoints corners(piece);
        std::array<double, 6> corner_gap;
        corner_gap.fill(infinity);
        Bounds result{false, 0, infinity};
        for (const std::uint32_t i : near.balls) {
            if (balls_.holds(i, piece)) {
                return {true, 0, 0};
            }
            double worst = -infinity;
            for (std::size_t c = 0; c < corners.count; ++c) {
                const double gap = balls_.gap(i, corners.points[c]);
                corner_gap[c] = std::min(corner_gap[c], gap);
                worst = std::max(worst, gap);
            }
            result.upper = std::min(result.upper, worst);
        }
        result.lower = *std::max_element(corner_gap.data(), corner_gap.data() + corners.count);
        return result;
    }

    /// Grows the ball that adds the least excess volume.
    void give(const Piece& piece) {
        std::vector<std::pair<double, std::uint32_t>> growths;
        for (std::uint32_t i = 0; i < balls_.size(); ++i) {
            if (std::isfinite(balls_.radius(i))) {
                growths.push_back({reach(balls_.center(i), piece) - balls_.radius(i), i});
            }
        }
        const std::size_t count = std::min(compared, growths.size());
        std::partial_sort(growths.begin(), growths.begin() + static_cast<std::ptrdiff_t>(count), growths.end());
        double least = std::numeric_limits<double>::infinity();
        std::uint32_t best = growths[0].second;
        double best_radius = 0;
        for (std::size_t k = 0; k < count; ++k) {
            const std::uint32_t i = growths[k].second;
            const double radius = radius_to_hold(i, piece);
            // A share of the plain growth breaks ties between balls that add no excess volume yet.
            const double whole =
                radius * radius * radius - spheres_[i].radius * spheres_[i].radius * spheres_[i].radius;
            const double cost = count == 1 ? 0 : cost_.of(spheres_, i, radius) + 0.02 * whole;
            if (cost < least) {
                least = cost;
                best = i;
                best_radius = radius;
            }
        }
        spheres_[best].radius = best_radius;
        balls_.set_radius(best, best_radius);
        grown_.push_back(best);
    }

    double radius_to_hold(std::uint32_t i, const Piece& piece) const {
        double radius = balls_.full_radius(i, reach(balls_.center(i), piece));
        return std::max(radius, spheres_[i].radius);
    }

    CancellationCounter asking_{64};
    std::vector<Sphere>& spheres_;
    Balls balls_;
    GrowthCost cost_;
    std::priority_queue<Entry> queue_;
    std::uint64_t made_ = 0;
    std::vector<std::uint32_t> grown_; ///< in order
    std::vector<std::uint32_t> scratch_;
};

} // namespace

/// Grows each ball to contain the uncovered part of its power cell (Aurenhammer 1987), visiting each triangle once. The
/// cells tile the surface, so balls that contain their cells cover it. Where gaps are wide, neighbours share them.
/// Growth by the worst gap first does not: there the ball that got a piece gets the next one, too.
static void grow_by_cells(const Solid& solid, std::vector<Sphere>& spheres) {
    const Balls balls(solid, spheres, growth_halvings, growth_caution);
    CreaseCuts cuts(balls, growth_halvings);
    std::vector<double> reach(spheres.size(), 0);
    std::vector<std::uint32_t> candidates;
    for (std::uint32_t i = 0; i < balls.piece_count(); ++i) {
        const Piece piece = balls.piece(i);
        candidates.clear();
        balls.candidates(piece, candidates);
        cuts.raise(piece, candidates, reach);
    }
    for (std::uint32_t i = 0; i < spheres.size(); ++i) {
        if (reach[i] > 0) {
            spheres[i].radius = std::max(spheres[i].radius, balls.full_radius(i, reach[i]));
        }
    }
}

std::size_t most_looks(const Solid& solid) {
    constexpr std::size_t looks_a_triangle = 20, least_looks = 20'000;
    return least_looks + looks_a_triangle * solid.surface().triangles.size();
}

void grow(const Solid& solid, std::vector<Sphere>& spheres, std::size_t looks) {
    std::vector<Sphere> grown = spheres;
    if (Growth(solid, grown).run(looks)) {
        spheres = std::move(grown);
    } else {
        grow_by_cells(solid, spheres);
    }
}

namespace {

void check_growable(const std::vector<Sphere>& spheres) {
    for (const Sphere& s : spheres) {
        if (is_finite(s.center) && std::isfinite(s.radius)) {
            return;
        }
    }
    throw Error(ErrorCode::geometry,
                "there is no sphere with finite centre and radius that could grow to cover the solid");
}

/// Closes gaps due to rounding, the only possible reason for a remaining gap.
void close_what_is_left(const Solid& solid, std::vector<Sphere>& spheres) {
    for (int round = 0; round < 3; ++round) {
        if (certify_surface(solid, spheres).holds) {
            return;
        }
        geometry::grow(solid, spheres, geometry::most_looks(solid));
    }
    // Balls that meet just at the surface can require more pieces than a proof may take. A slightly larger radius lets
    // it succeed.
    for (const double share : {1e-9, 1e-6, 1e-3}) {
        if (certify_surface(solid, spheres).holds) {
            return;
        }
        for (Sphere& s : spheres) {
            s.radius *= 1 + share;
        }
    }
    if (!certify_surface(solid, spheres).holds) {
        throw Error(ErrorCode::internal, "growth left a part of the surface uncovered");
    }
}

} // namespace

std::vector<Sphere> grown_to_cover(const Solid& solid, std::vector<Sphere> spheres) {
    check_growable(spheres);
    std::vector<double> floor;
    for (const Sphere& s : spheres) {
        floor.push_back(s.radius);
    }
    if (!certify_surface(solid, spheres).holds) {
        geometry::grow(solid, spheres, geometry::most_looks(solid));
        geometry::shrink(solid, spheres, floor);
        close_what_is_left(solid, spheres);
    }
    return grown_to_fill(solid, std::move(spheres)).spheres();
}

} // namespace foam::geometry
