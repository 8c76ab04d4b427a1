// The least radii that keep a surface covered.
#include "measure/exposure.hpp"
#include "proof/growth.hpp"

#include <foam/base/cancellation.hpp>

#include <numeric>

namespace foam::inline geometry {
namespace {

/// Share of the extent below which pieces are not split: they count as needed entirely.

/// Branch and bound over the pieces that no other ball contains, the farthest first. Only pieces that reach farther
/// than the needed radius are split.
///
/// Other balls contain everything farther away than `limit`, as this ball and the others together cover everything.
class Need {
public:
    Need(const Balls& balls, std::uint32_t ball, double limit, std::size_t& looks)
        : balls_(balls), ball_(ball), limit_(limit), looks_(looks) {}

    /// Returns the needed radius, ignoring the triangles with skip[i] != 0. When no looks remain, it is the limit.
    double run(const std::vector<char>& skip) {
        CancellationCounter asking(256);
        for (std::size_t run = 0; run < balls_.runs().size(); ++run) {
            asking.check();
            if (beyond_limit(balls_.runs()[run])) {
                continue;
            }
            for (const std::uint32_t i : balls_.runs().triangles(run)) {
                if (!skip[i]) {
                    push(balls_.piece(i), i);
                }
            }
        }
        std::make_heap(queue_.begin(), queue_.end());
        while (!queue_.empty() && queue_.front().far > need_) {
            asking.check();
            if (looks_ == 0) {
                return limit_;
            }
            --looks_;
            std::pop_heap(queue_.begin(), queue_.end());
            const Entry next = queue_.back();
            queue_.pop_back();
            examine(next);
        }
        return need_;
    }

private:
    /// Indices of candidates, [begin, end) among candidates_.
    struct Range {
        std::size_t begin, end;
    };
    struct Part {
        Piece piece;
        Range candidates; ///< those of the piece it was cut from
    };
    struct Entry {
        double far;         ///< largest distance of a point of it from the ball's centre
        std::uint32_t name; ///< id: a whole triangle, or piece_count() + the number of a part
        bool operator<(const Entry& other) const { return far != other.far ? far < other.far : name > other.name; }
    };

    Vec3 center() const { return balls_.center(ball_); }

    /// Returns whether all triangles of a run are farther away than the limit.
    bool beyond_limit(const SurfaceRuns::Run& run) const {
        const double rounding = 1e-12 * (balls_.extent() + limit_);
        return distance(center(), run.center) - run.radius > limit_ + rounding;
    }

    /// Returns a lower bound of the distance of the piece from the ball's centre.
    double nearest(const Piece& piece) const {
        return piece.curved ? reach(center(), piece) - diameter_of(piece)
                            : distance(center(), closest_on_triangle(piece.corners, center()));
    }

    bool push(const Piece& piece, std::uint32_t name) {
        const double far = reach(center(), piece);
        if (far <= need_ || (far > limit_ && nearest(piece) > limit_)) {
            return false;
        }
        queue_.push_back({far, name});
        return true;
    }

    void push_part(const Piece& piece, const Range& candidates) {
        if (push(piece, static_cast<std::uint32_t>(balls_.piece_count() + parts_.size()))) {
            parts_.push_back({piece, candidates});
            std::push_heap(queue_.begin(), queue_.end());
        }
    }

    void examine(const Entry& entry) {
        Range range{candidates_.size(), 0};
        Piece piece;
        if (entry.name < balls_.piece_count()) {
            piece = balls_.piece(entry.name);
            balls_.candidates(piece, candidates_);
        } else {
            const Part& part = parts_[entry.name - balls_.piece_count()];
            piece = part.piece;
            if (part.candidates.begin < part.candidates.end) {
                balls_.candidates(piece, part.candidates.begin, part.candidates.end, candidates_);
            }
        }
        range.end = candidates_.size();
        const std::span<const std::uint32_t> candidates(candidates_.data() + range.begin, range.end - range.begin);
        if (std::any_of(candidates.begin(), candidates.end(),
                        [&](std::uint32_t i) { return balls_.holds(i, piece); })) {
            return;
        }
        for (const Vec3& corner : PiecePoints(piece)) {
            if (std::all_of(candidates.begin(), candidates.end(),
                            [&](std::uint32_t i) { return balls_.gap(i, corner) > 0; })) {
                need_ = std::max(need_, distance(center(), corner));
            }
        }
        if (size_of(piece) <= smallest_grown_piece * balls_.extent() || piece.level >= growth_halvings) {
            need_ = entry.far;
            return;
        }
        if (entry.far > need_) {
            const auto [first, second] = halves(piece);
            push_part(first, range);
            push_part(second, range);
        }
    }

    const Balls& balls_;
    std::uint32_t ball_;
    double limit_;
    std::size_t& looks_; ///< remaining pieces to examine
    double need_ = 0;
    std::vector<Part> parts_;
    std::vector<Entry> queue_; ///< heap
    std::vector<std::uint32_t> candidates_;
};

} // namespace

double needed_radius(Balls& balls, std::uint32_t i, double limit, std::size_t& looks) {
    balls.set_radius(i, -std::numeric_limits<double>::infinity());
    const auto need_of = [&](const std::vector<char>& skip) {
        const double need = Need(balls, i, limit, looks).run(skip);
        return need > 0 ? balls.full_radius(i, need) : 0;
    };
    // Round parts that another ball contains need nothing. Those that this one can contain may be contained whole or by
    // pieces.
    std::vector<char> held(balls.piece_count(), 0), whole(balls.piece_count(), 0);
    double around = 0;
    for (const RoundPart& part : balls.round_parts()) {
        const bool by_another = balls.held(part);
        const double radius = balls.radius_around(i, part);
        const bool by_this = !by_another && radius <= limit;
        around = by_this ? std::max(around, radius) : around;
        std::fill(held.begin() + part.begin, held.begin() + part.end, by_another);
        std::fill(whole.begin() + part.begin, whole.begin() + part.end, by_another || by_this);
    }
    const double need = need_of(held);
    return around > 0 && around < need ? std::min(need, std::max(around, need_of(whole))) : need;
}

void shrink(const Solid& solid, std::vector<Sphere>& spheres, const std::vector<double>& floor) {
    Balls balls(solid, spheres, growth_halvings, growth_caution);
    const Exposure exposure(solid, 48);
    std::size_t looks = 2 * most_looks(solid);
    std::vector<double> outside(spheres.size(), 0);
    std::vector<std::uint32_t> order;
    for (std::uint32_t i = 0; i < spheres.size(); ++i) {
        if (std::isfinite(balls.radius(i)) && spheres[i].radius > floor[i]) {
            outside[i] = exposure.area(spheres, i, spheres[i].radius);
            order.push_back(i);
        }
    }
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return outside[a] > outside[b]; });
    for (const std::uint32_t i : order) {
        const double now = spheres[i].radius;
        spheres[i].radius = std::min(now, std::max(needed_radius(balls, i, now, looks), floor[i]));
        balls.set_radius(i, spheres[i].radius);
    }
}

} // namespace foam::geometry
