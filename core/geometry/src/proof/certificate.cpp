// Proof that a surface lies in a union of balls, or the worst gap by branch and bound.
#include "proof/cover.hpp"
#include "proof/crease_cuts.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/geometry/internal/proof.hpp>

namespace foam::inline geometry {
namespace {


/// Share of the extent below which edges of pieces are not split. The gap that such a piece may hide, and the growth
/// that closes it, are of that size.
constexpr double smallest_proved_piece = 1e-9;
/// Relative accuracy of the gap, which is an upper bound.
constexpr double gap_accuracy = 1e-3;

/// Limits on the number of pieces of a proof. Proofs of usual sphere models need some pieces per triangle. Where balls
/// end along a whole edge or face of a needle, the number would be unlimited; pieces that are open at the limit count
/// as uncovered.
constexpr std::size_t least_pieces = 1'000'000, pieces_a_triangle = 100;

class Proof {
public:
    Proof(const Solid& solid, std::span<const Sphere> spheres, int depth)
        : shrink_(std::ldexp(1.0, -depth)), most_halvings_(static_cast<std::uint32_t>(3 * depth)),
          balls_(solid, spheres, most_halvings_), cuts_(balls_, most_halvings_),
          most_pieces_(least_pieces + pieces_a_triangle * balls_.piece_count()) {}

    geometry::CoverProof run() {
        certificate_.holds = true;
        std::vector<char> proved(balls_.round_parts().empty() ? 0 : balls_.piece_count(), 0);
        for (const geometry::RoundPart& part : balls_.round_parts()) {
            std::fill(proved.begin() + part.begin, proved.begin() + part.end, balls_.held(part));
        }
        std::size_t next = 0;
        for (const std::uint32_t i : balls_.open_triangles()) {
            certificate_.pieces += i - next; // those between lie in one ball each
            next = i + std::size_t{1};
            if (proved.empty() || !proved[i]) {
                asking_.check();
                examine_triangle(i);
            }
        }
        certificate_.pieces += balls_.piece_count() - next;
        if (!certificate_.holds) {
            certificate_.growth = std::max(certificate_.growth, proved_gap_);
            certificate_.witness = balls_.to_solid(certificate_.witness);
        }
        return {certificate_, balls_.piece_count(), halvings_};
    }

private:
    struct Waiting {
        Piece piece;
        std::size_t begin, end; // range of the candidates in indices_
    };

    void examine_triangle(std::uint32_t i) {
        const Piece whole = balls_.piece(i);
        ++certificate_.pieces;
        if (balls_.size() > 0 && balls_.holds(last_, whole)) {
            return; // as its neighbour
        }
        indices_.clear();
        balls_.candidates(whole, indices_);
        if (!indices_.empty() && balls_.holds(indices_[0], whole)) {
            last_ = indices_[0];
            return;
        }
        const bool covered = cuts_.cover(whole, indices_);
        certificate_.pieces += cuts_.pieces();
        halvings_ = std::max(halvings_, cuts_.most_cuts());
        if (!covered) {
            halve(whole);
        }
    }

    /// Proves by halving alone, independent of what cuts could not prove.
    void halve(const Piece& whole) {
        smallest_ = std::max(smallest_proved_piece * balls_.extent(), shrink_ * geometry::size_of(whole));
        waiting_.assign(1, {whole, 0, indices_.size()});
        while (!waiting_.empty()) {
            asking_.check();
            const Waiting next = waiting_.back();
            waiting_.pop_back();
            indices_.resize(next.end);
            if (next.piece.level == 0) {
                examine(next);
                continue;
            }
            ++certificate_.pieces;
            halvings_ = std::max(halvings_, next.piece.level);
            balls_.candidates(next.piece, next.begin, next.end, indices_);
            examine({next.piece, next.end, indices_.size()});
        }
    }

    /// Discards the piece if it is covered, too small to split, or not the worst; otherwise queues its halves.
    void examine(const Waiting& item) {
        double upper = std::numeric_limits<double>::infinity(); // growth of one ball that contains the piece
        const geometry::PiecePoints corners(item.piece);
        std::array<double, 6> corner_gap;
        corner_gap.fill(upper);
        for (std::size_t k = item.begin; k < item.end; ++k) {
            if (balls_.holds(indices_[k], item.piece)) {
                return;
            }
            double worst = -std::numeric_limits<double>::infinity();
            for (std::size_t c = 0; c < corners.count; ++c) {
                const double gap = balls_.gap(indices_[k], corners.points[c]);
                corner_gap[c] = std::min(corner_gap[c], gap);
                worst = std::max(worst, gap);
            }
            upper = std::min(upper, worst);
        }
        const auto* const worst_gap = std::max_element(corner_gap.data(), corner_gap.data() + corners.count);
        const std::size_t farthest = static_cast<std::size_t>(worst_gap - corner_gap.data());
        const double lower = corner_gap[farthest];
        if (lower > 0 && (certificate_.holds || lower > proved_gap_)) {
            fail(item.piece, corners.points[farthest]);
            proved_gap_ = lower;
        }
        if (!certificate_.holds && upper <= std::max(certificate_.growth, proved_gap_)) {
            return;
        }
        const bool small = geometry::size_of(item.piece) <= smallest_ || item.piece.level >= most_halvings_ ||
                           certificate_.pieces >= most_pieces_;
        if (small || !(upper - lower > gap_accuracy * upper)) {
            fail(item.piece, corners.points[farthest]);
            certificate_.growth = std::max(certificate_.growth, std::max(upper, 0.0));
            return;
        }
        const auto [first, second] = geometry::halves(item.piece);
        waiting_.push_back({second, item.begin, item.end});
        waiting_.push_back({first, item.begin, item.end});
    }

    void fail(const Piece& piece, const Vec3& witness) {
        certificate_.holds = false;
        certificate_.witness = witness;
        certificate_.triangle = piece.triangle;
    }

    CancellationCounter asking_{256};
    double shrink_;
    std::uint32_t most_halvings_;
    Balls balls_;
    geometry::CreaseCuts cuts_;
    std::size_t most_pieces_;
    std::uint32_t last_ = 0; // ball that contained the previous triangle
    double smallest_ = 0;
    double proved_gap_ = 0; // of a corner that no ball contains
    std::uint32_t halvings_ = 0;
    Certificate certificate_;
    std::vector<Waiting> waiting_;
    std::vector<std::uint32_t> indices_;
};

} // namespace

CoverProof prove_cover_by_spheres(const Solid& solid, std::span<const Sphere> spheres, int depth) {
    return Proof(solid, spheres, std::clamp(depth, 0, 60)).run();
}

} // namespace foam::geometry
