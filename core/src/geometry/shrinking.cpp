// The least radii that keep a surface covered.
#include "geometry/exposure.hpp"
#include "geometry/growth.hpp"

#include <foam/cancellation.hpp>

#include <numeric>

namespace foam::geometry {
namespace {

/// Pieces smaller than this share of the extent are not split: they count as needed whole.
constexpr double smallest_piece = 1e-8;

/// Branch and bound over the pieces that no other ball holds, the farthest first: only those are split that reach
/// farther than the need.
///
/// What lies farther away than `limit` is held by other balls, as ball and others together hold everything.
class Need {
public:
    Need(const Balls& balls, std::uint32_t ball, double limit, std::size_t& looks)
        : balls_(balls), ball_(ball), limit_(limit), looks_(looks) {}

    /// Leaves out the triangles with skip[i] != 0. Once there are no looks left, the limit is what it needs.
    double run(const std::vector<char>& skip) {
        CancellationCounter asking(256);
        for (std::uint32_t i = 0; i < balls_.piece_count(); ++i) {
            asking.check();
            if (!skip[i]) {
                push(balls_.piece(i), i);
            }
        }
        std::make_heap(queue_.begin(), queue_.end());
        while (!queue_.empty() && queue_.front().far > need_) {
            asking.check();
            if (looks_ == 0) {
                return std::max(need_, limit_);
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
        std::size_t begin = 0, end = 0;
    };
    struct Part {
        Piece piece;
        Range candidates; ///< of the piece it was cut from
    };
    struct Entry {
        double far;         ///< the most that a point of it is away from the ball's centre
        std::uint32_t name; ///< a whole triangle, or piece_count() + the number of a part
        bool operator<(const Entry& other) const { return far != other.far ? far < other.far : name > other.name; }
    };

    Vec3 center() const { return balls_.center(ball_); }

    /// No more than the distance of the piece from the ball's centre.
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
        if (size_of(piece) <= smallest_piece * balls_.extent() || piece.level >= growth_halvings) {
            need_ = std::max(need_, entry.far);
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
    std::size_t& looks_; ///< at pieces, that are left
    double need_ = 0;
    std::vector<Part> parts_;
    std::vector<Entry> queue_; ///< a heap
    std::vector<std::uint32_t> candidates_;
};

} // namespace

double needed_radius(Balls& balls, std::uint32_t i, double limit, std::size_t& looks) {
    balls.set_radius(i, -std::numeric_limits<double>::infinity());
    const auto need_of = [&](const std::vector<char>& skip) {
        const double need = Need(balls, i, limit, looks).run(skip);
        return need > 0 ? balls.full_radius(i, need) : 0;
    };
    // Round parts that another ball holds need nothing. Those that this one can hold may be held whole or by pieces.
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

void shrink(const Solid& solid, std::vector<Sphere>& spheres, const std::vector<double>& floor, double quantum,
            const ShrinkPlan& plan) {
    constexpr double part_of_the_way = 1.0 / 3;
    Balls balls(solid, spheres, growth_halvings, growth_caution);
    const Exposure exposure(solid, 48);
    std::size_t looks = most_looks(solid) * (static_cast<std::size_t>(plan.rounds) + 1);
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
    for (int round = plan.drop_first ? 0 : 1; round <= plan.rounds; ++round) {
        const double way = round < plan.rounds ? part_of_the_way : 1;
        for (const std::uint32_t i : order) {
            const double now = spheres[i].radius;
            const double need = std::max(needed_radius(balls, i, now, looks), floor[i]);
            double wanted = way < 1 ? now - way * (now - need) : need;
            if (round == 0) {
                wanted = need == floor[i] ? need : now;
            }
            spheres[i].radius = std::min(now, rounded_up(wanted, quantum));
            balls.set_radius(i, spheres[i].radius);
        }
    }
}

} // namespace foam::geometry
