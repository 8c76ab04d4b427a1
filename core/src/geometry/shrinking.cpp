// The least radii that keep a surface covered.
#include "geometry/exposure.hpp"
#include "geometry/growth.hpp"

#include <numeric>

namespace foam::geometry {
namespace {

/// Pieces smaller than this share of the extent are not split: they count as needed whole.
constexpr double smallest_piece = 1e-8;

/// Branch and bound over the pieces that no other ball holds, the farthest first.
class Need {
public:
    Need(const Balls& balls, std::uint32_t ball) : balls_(balls), ball_(ball) {}

    /// Leaves out the triangles with skip[i] != 0.
    double run(double limit, const std::vector<char>& skip) {
        std::vector<std::pair<double, std::uint32_t>> order;
        for (std::uint32_t i = 0; i < balls_.piece_count(); ++i) {
            if (skip[i]) {
                continue;
            }
            const Piece piece = balls_.piece(i);
            const double far = reach(center(), piece);
            if (far - diameter_of(piece) > limit) {
                continue; // no point of it is in the ball: others hold it
            }
            order.push_back({-far, i});
        }
        std::sort(order.begin(), order.end());
        for (const auto& [far, i] : order) {
            if (-far <= need_) {
                break;
            }
            examine_triangle(i);
        }
        return need_;
    }

private:
    struct Waiting {
        Piece piece;
        std::size_t begin, end;
    };

    Vec3 center() const { return balls_.center(ball_); }

    void examine_triangle(std::uint32_t i) {
        const Piece whole = balls_.piece(i);
        indices_.clear();
        balls_.candidates(whole, indices_);
        waiting_.assign(1, {whole, 0, indices_.size()});
        while (!waiting_.empty()) {
            const Waiting next = waiting_.back();
            waiting_.pop_back();
            indices_.resize(next.end);
            if (reach(center(), next.piece) <= need_) {
                continue;
            }
            if (next.piece.level == 0) {
                examine(next);
            } else if (next.begin == next.end) {
                examine(next);
            } else {
                balls_.candidates(next.piece, next.begin, next.end, indices_);
                examine({next.piece, next.end, indices_.size()});
            }
        }
    }

    void examine(const Waiting& item) {
        for (std::size_t k = item.begin; k < item.end; ++k) {
            if (balls_.holds(indices_[k], item.piece)) {
                return;
            }
        }
        for (const Vec3& corner : PiecePoints(item.piece)) {
            bool uncovered = true;
            for (std::size_t k = item.begin; uncovered && k < item.end; ++k) {
                uncovered = balls_.gap(indices_[k], corner) > 0;
            }
            if (uncovered) {
                need_ = std::max(need_, distance(center(), corner));
            }
        }
        const double far = reach(center(), item.piece);
        if (far <= need_) {
            return;
        }
        if (size_of(item.piece) <= smallest_piece * balls_.extent() || item.piece.level >= growth_halvings) {
            need_ = far;
            return;
        }
        const auto [first, second] = halves(item.piece);
        const bool first_is_farther = reach(center(), first) >= reach(center(), second);
        waiting_.push_back({first_is_farther ? second : first, item.begin, item.end});
        waiting_.push_back({first_is_farther ? first : second, item.begin, item.end});
    }

    const Balls& balls_;
    std::uint32_t ball_;
    double need_ = 0;
    std::vector<Waiting> waiting_;
    std::vector<std::uint32_t> indices_;
};

} // namespace

double needed_radius(Balls& balls, std::uint32_t i, double limit) {
    balls.set_radius(i, -std::numeric_limits<double>::infinity());
    const auto need_of = [&](const std::vector<char>& skip) {
        const double need = Need(balls, i).run(limit, skip);
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
            const double need = std::max(needed_radius(balls, i, now), floor[i]);
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
