// Proof that elements leave no cavity in a solid whose surface they hold.
#include "proof/ball_tops.hpp"
#include "proof/bodies.hpp"
#include "proof/body_cuts.hpp"
#include "proof/deepest.hpp"
#include "proof/element_proof.hpp"
#include "proof/nerve.hpp"
#include "proof/surface_pieces.hpp"
#include "proof/walls.hpp"
#include "solid/solid_data.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/geometry/internal/proof.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace foam::inline geometry {
namespace {

constexpr std::uint32_t halvings = 120;
/// Limits on the pieces of an element's surface; those that are open at the limit count as open.
constexpr std::size_t most_pieces = 20'000, most_pieces_of_cuts = 2'000;
constexpr std::size_t most_open = 16;   ///< pieces of an element that are noted; then the next element's turn comes
constexpr double smallest_piece = 1e-8; ///< share of the extent
constexpr int levels_without_distance = 6;
constexpr std::size_t most_climbs = 100; ///< to the deepest points of cavities
/// Up: the direction whose farthest point of a cavity is looked for. Along no axis or diagonal that meshes have.
constexpr Vec3 up{0.3746065934, 0.5523, 0.74471};

/// The proof. docs/dev/certificate.md has the argument: elements whose union has no void leave no cavity, as their
/// nerve tells. Else, a cavity has a topmost point, where at least three elements meet, and from which no way leads up.
/// So a piece of the surface of element i is done if
/// 1. it lies in another element, or outside the solid; or
/// 2. fewer than two elements after i meet it: each top belongs to the first of the elements that meet there; or
/// 3. there is a way up from all its points, along which no wall of the elements from i on falls; or
/// 4. there is a way out: along a vector that leads through no element to a place outside the solid.
class Cavities {
public:
    Cavities(const Solid& solid, const Elements& elements, bool all)
        : solid_(solid), all_(all), origin_(solid.bounds().center()), elements_(elements.begin(), elements.end()),
          extent_(reach_from(origin_, elements_)), bodies_(elements, origin_, extent_, halvings),
          cuts_(bodies_, halvings), of_walls_(elements_, bodies_) {}

    SolidProof run() {
        proof_.holds = true;
        look_at_thin_ones();
        std::optional<BallTops> balls = as_balls();
        if (proof_.holds && !balls && Nerve(bodies_, of_walls_).has_no_void()) {
            return std::move(proof_);
        }
        for (std::uint32_t i = 0; i < elements_.size() && !done(); ++i) {
            if (bodies_.holds_something(i) && (!balls || !is_proved(*balls, i))) {
                look_at(i);
            }
        }
        return std::move(proof_);
    }

private:
    struct Ball {
        Vec3 center;
        double radius;
    };
    enum class Beyond { nothing, solid, unknown };

    void look_at_thin_ones() {
        for (std::uint32_t i = 0; i < elements_.size() && !done(); ++i) {
            if (!bodies_.holds_something(i) && is_valid(elements_[i]) && may_hold_something(elements_[i])) {
                patch_.points = {elements_[i].pose.translation - origin_};
                fail(i, patch_.points.front(), false);
            }
        }
    }
    /// Returns whether an element that is thinner than the rounding here may hold some of the surface in certify().
    bool may_hold_something(const Element& element) const {
        constexpr double less = 0.5; // of the slack there, at most
        double most = 0;
        for (const Vec3& vertex : solid_.surface().vertices) {
            most = std::max(most, distance(vertex, origin_));
        }
        return Bodies(Elements(std::vector{element}), origin_, most, halvings, less).holds_something(0) ||
               std::any_of(solid_.parts().begin(), solid_.parts().end(),
                           [&](const Solid::Part& part) { return contains_by_lengths(element, part); });
    }
    /// Returns the elements as balls, those without a thickness as points; nothing if one is of another kind.
    std::optional<BallTops> as_balls() const {
        std::vector<Vec3> centers;
        std::vector<double> radii;
        for (std::uint32_t i = 0; i < elements_.size(); ++i) {
            if (elements_[i].kind != Element::Kind::sphere) {
                return std::nullopt;
            }
            const bool some = bodies_.holds_something(i);
            centers.push_back(some ? bodies_.center(i) : Vec3{});
            radii.push_back(some ? elements_[i].radius : 0);
        }
        return BallTops(std::move(centers), std::move(radii), normalized(up));
    }
    /// Returns whether all tops of a ball are outside the solid for certain. Quick: no piece of its surface is looked
    /// at.
    bool is_proved(BallTops& balls, std::uint32_t i) {
        return balls.of(i, tops_) && std::all_of(tops_.begin(), tops_.end(), [&](const BallTop& top) {
                   return is_outside({top.point, top.error}) ||
                          (beyond(top.point) == Beyond::nothing && is_outside({top.point, top.error}));
               });
    }
    bool done() const { return !proof_.holds && !all_; }

    void look_at(std::uint32_t i) {
        const ElementSurface surface(elements_[i], origin_);
        left_ = most_pieces;
        const std::size_t open_before = proof_.open.size();
        known_ = {};
        patch_.element = i;
        waiting_.assign(surface.pieces().begin(), surface.pieces().end());
        while (!waiting_.empty() && !done() && proof_.open.size() < open_before + most_open) {
            asking_.check();
            const SurfacePiece piece = waiting_.back();
            waiting_.pop_back();
            ++proof_.pieces;
            surface.points(piece, patch_.points);
            surface.normals(piece, patch_.normals);
            patch_.measure();
            const bool cuttable = piece.flat && piece.level == 0;
            if (is_closed(i, piece.level, cuttable)) {
                continue;
            }
            if (cuttable && cut(i, surface)) {
                continue;
            }
            if (left_ == 0 || patch_.radius <= smallest_piece * extent_) {
                fail(i, patch_.middle, false);
                continue;
            }
            --left_;
            const auto [first, second] = surface.halves(piece, share_to_cut(i, surface, piece));
            waiting_.push_back(second);
            waiting_.push_back(first);
        }
    }

    /// Returns whether the patch is done, after fail() if it is open for certain. `cuttable`: planes of others may cut
    /// it.
    bool is_closed(std::uint32_t i, int level, bool cuttable) {
        if (is_outside({patch_.middle, patch_.radius})) {
            return true;
        }
        bodies_.meeting(patch_.box, near_);
        if (!may_have_a_top(i) || is_held(i)) {
            return true;
        }
        if (cuttable && std::any_of(later_.begin(), later_.end(), [&](std::uint32_t k) { return has_planes(k); })) {
            return false;
        }
        if (leads_up(i) || (level >= levels_without_distance && is_far())) {
            return true;
        }
        if (patch_.normals.empty() ? level % 3 != 1 : level < 8 || level % 4 != 0) { // else it would take long
            return false;
        }
        Vec3 out{};
        switch (way_out(i, out)) {
        case Beyond::nothing:
            return true;
        case Beyond::solid:
            fail(i, out, true);
            return true;
        case Beyond::unknown:
            break;
        }
        return false;
    }
    bool has_planes(std::uint32_t k) const { return !bodies_.planes(k).empty(); }
    /// Returns whether the patch is outside the solid by its distance.
    bool is_far() { return beyond(patch_.middle) == Beyond::nothing && is_outside({patch_.middle, patch_.radius}); }
    bool is_held(std::uint32_t i) const {
        return std::any_of(near_.begin(), near_.end(), [&](std::uint32_t k) {
            const auto holds = [&](const Vec3& p) { return bodies_.holds(k, p); };
            return k != i && holds(patch_.middle) && std::all_of(patch_.points.begin(), patch_.points.end(), holds);
        });
    }
    /// Sets later_ to the elements after i that meet the patch. Returns false if they are fewer than two.
    bool may_have_a_top(std::uint32_t i) {
        later_.clear();
        const auto first = std::upper_bound(near_.begin(), near_.end(), i);
        if (near_.end() - first < 2) {
            return false;
        }
        std::copy_if(first, near_.end(), std::back_inserter(later_),
                     [&](std::uint32_t k) { return !of_walls_.is_clear(patch_, k); });
        return later_.size() >= 2;
    }
    /// Returns whether a way leads up from the patch, or fewer than two of the later elements meet it.
    bool leads_up(std::uint32_t i) {
        walls_.clear();
        std::size_t meeting = 0;
        for (const std::uint32_t k : later_) {
            const std::size_t before = walls_.size();
            if (of_walls_.add(patch_, k, walls_)) {
                ++meeting;
            } else {
                walls_.resize(before);
            }
        }
        if (meeting < 2) {
            return true;
        }
        of_walls_.add(patch_, i, walls_);
        const Vec3 way = away_from_walls(up);
        return dot(way, up) > 0 && leads_on(way);
    }

    /// Replaces a flat piece by what is left of it outside the boxes and hulls that meet it. Returns false if there are
    /// none.
    bool cut(std::uint32_t i, const ElementSurface& surface) {
        std::erase_if(near_, [&](std::uint32_t k) { return k == i || bodies_.planes(k).empty(); });
        if (near_.empty()) {
            return false;
        }
        const std::vector<Vec3> corners = patch_.points;
        for (std::size_t k = 2; k < corners.size(); ++k) {
            const Corners triangle{corners[0], corners[k - 1], corners[k]};
            for (const std::vector<Vec3>& polygon : cuts_.rest(triangle, near_, most_pieces_of_cuts)) {
                for (std::size_t c = 2; c < polygon.size(); ++c) {
                    waiting_.push_back(surface.flat_piece({polygon[0], polygon[c - 1], polygon[c]}));
                }
            }
        }
        return true;
    }

    /// Returns where to cut a piece along the axis of a round surface: where one other element ends in a plane, if
    /// there is such a one, else 0.
    double share_to_cut(std::uint32_t i, const ElementSurface& surface, const SurfacePiece& piece) {
        const std::array<Vec3, 2> side = surface.straight_side(piece);
        for (const std::uint32_t k : near_) {
            if (k == i || side[0] == side[1]) {
                continue;
            }
            walls_.clear();
            of_walls_.add(patch_, k, walls_);
            if (walls_.size() != 1 || !walls_[0].flat) {
                continue;
            }
            const double margin = of_walls_.margin_of(k);
            const double along = dot(walls_[0].normal, side[1] - side[0]);
            // the value of the corner farthest beyond
            const double high = walls_[0].low + margin + patch_.width_along(walls_[0].normal);
            const double share = along != 0 ? 1 - (high + margin) / std::abs(along) : 0;
            if (share > 0.001 && share < 0.999) {
                return along > 0 ? share : 1 - share;
            }
        }
        return 0;
    }

    /// Returns a direction near `wanted`, which need not be unit, that leads away from all walls, if it finds one.
    Vec3 away_from_walls(const Vec3& wanted) {
        constexpr int rounds = 8;
        find_pairs();
        Vec3 direction = wanted;
        for (int round = 0; round < rounds; ++round) {
            direction = normalized(direction);
            bool changed = false;
            for (const Wall& wall : walls_) {
                const double along = dot(direction, wall.normal), least = wall.flat ? 0 : wall.turn;
                if (along < least) {
                    direction += wall.normal * (1.2 * least - along);
                    changed = true;
                }
            }
            for (const Pair& pair : pairs_) {
                direction -= pair.normal * dot(direction, pair.normal);
                direction -= pair.between * std::min(0.0, dot(direction, pair.between));
            }
            if (!changed) {
                break;
            }
        }
        return normalized(direction);
    }
    /// Finds planes that are nearly opposite, as of elements that touch: only a direction along both leads away.
    void find_pairs() {
        constexpr double opposite = -0.99;
        pairs_.clear();
        for (std::size_t a = 0; a < walls_.size(); ++a) {
            for (std::size_t b = 0; b < a; ++b) {
                const Vec3 &m = walls_[a].normal, &n = walls_[b].normal;
                if (walls_[a].flat && walls_[b].flat && dot(m, n) < opposite) {
                    const Vec3 sum = m + n;
                    pairs_.push_back({m, normalized(sum - m * dot(sum, m))});
                }
            }
        }
    }

    /// Looks for a way out of the piece. Sets `out` to the end of the middle's, and returns what is there.
    Beyond way_out(std::uint32_t i, Vec3& out) {
        constexpr int rounds = 4;
        Vec3 way{};
        before_.clear();
        for (int round = 0; round < rounds; ++round) {
            meet(i, way);
            if (round > 0 && met_ == before_) {
                out = patch_.middle + way;
                return way != Vec3{} && leads_on(way) ? beyond(out) : Beyond::unknown;
            }
            before_ = met_;
            Vec3 wanted{};
            for (const Wall& wall : walls_) {
                wanted += wall.normal;
            }
            for (const Vec3& normal : patch_.normals) {
                wanted += normal / static_cast<double>(patch_.normals.size());
            }
            const Vec3 direction = away_from_walls(wanted);
            const double length = length_out(direction);
            if (!(length < extent_)) {
                break;
            }
            way = direction * length;
        }
        return Beyond::unknown;
    }
    /// Sets met_ to the elements that the piece may meet on a way, this one among them, and walls_ to theirs.
    void meet(std::uint32_t i, const Vec3& way) {
        Box box = patch_.box;
        box.add(patch_.box.low + way);
        box.add(patch_.box.high + way);
        const double room = of_walls_.margin_of(i), length = norm(way);
        bodies_.meeting(Box::about(box.center(), (box.high - box.low) * 0.5 + Vec3{room, room, room}), met_);
        if (std::find(met_.begin(), met_.end(), i) == met_.end()) {
            met_.push_back(i);
        }
        walls_.clear();
        std::erase_if(met_, [&](std::uint32_t k) {
            const bool clear = !of_walls_.add(patch_, k, walls_);
            const bool far = clear && walls_.back().low > length; // no way of this length gets there
            if (far) {
                walls_.pop_back();
            }
            return far;
        });
    }
    bool leads_on(const Vec3& way) const {
        return std::all_of(walls_.begin(), walls_.end(),
                           [&](const Wall& wall) { return of_walls_.grows(patch_, wall, way); });
    }
    /// Returns how far the piece has to go to be outside all elements that it meets; infinite if that is not found.
    double length_out(const Vec3& direction) const {
        constexpr double more = 1.5;
        const double width = patch_.width_along(direction);
        double length = 0;
        for (const std::uint32_t k : met_) {
            double least = std::numeric_limits<double>::infinity();
            for (const Wall& wall : walls_) {
                if (wall.element == k) {
                    least = std::min(least,
                                     of_walls_.length_beyond(patch_, wall, direction, width + of_walls_.margin_of(k)));
                }
            }
            length = std::max(length, least);
        }
        return more * length;
    }

    /// Returns whether the point is in the solid, and remembers how far from it all is outside.
    Beyond beyond(const Vec3& p) {
        if (is_outside({p, 0})) {
            return Beyond::nothing;
        }
        const double away = SolidAccess::data(solid_).distance_to_filled(p + origin_);
        if (std::abs(away) <= 1e-13 * (extent_ + norm(origin_))) {
            return Beyond::unknown;
        }
        if (away > 0) {
            known_ = {p, away * (1 - 1e-5)};
            return Beyond::nothing;
        }
        return Beyond::solid;
    }
    /// Returns whether a ball is known to be outside the solid.
    bool is_outside(const Ball& ball) const {
        const Box& box = solid_.bounds();
        const Vec3 p = ball.center + origin_;
        for (int axis = 0; axis < 3; ++axis) {
            if (p[axis] - ball.radius > box.high[axis] || p[axis] + ball.radius < box.low[axis]) {
                return true;
            }
        }
        const double room = known_.radius - ball.radius;
        return room > 0 && squared_norm(ball.center - known_.center) < room * room;
    }

    /// Notes the open patch, with the deepest point of the cavity that is found from the witness.
    void fail(std::uint32_t i, const Vec3& witness, bool found) {
        proof_.holds = false;
        constexpr double first_step = 0.02, least_step = 1e-9; // of the extent
        DeepPoint deepest{witness + origin_, 0};
        if (proof_.open.size() < most_climbs) {
            deepest = deepest_from(SolidAccess::data(solid_), elements_, witness + origin_, first_step * extent_,
                                   (found ? first_step : least_step) * extent_);
        }
        if (proof_.open.empty() || deepest.depth > proof_.depth) {
            proof_.witness = deepest.point;
            proof_.found = deepest.depth > 0;
            proof_.depth = deepest.depth;
        }
        SolidProof::Open open{i, {}};
        for (const Vec3& p : patch_.points) {
            open.points.push_back(p + origin_);
        }
        open.points.push_back(deepest.point);
        proof_.open.push_back(std::move(open));
    }

    const Solid& solid_;
    bool all_;
    Vec3 origin_;
    std::vector<Element> elements_;
    double extent_;
    Bodies bodies_;
    BodyCuts cuts_;
    Walls of_walls_;
    std::vector<BallTop> tops_; ///< of the present element
    std::size_t left_ = 0;
    std::vector<SurfacePiece> waiting_;
    PlacedPiece patch_; ///< the present piece
    Ball known_{};      ///< outside the solid
    std::vector<std::uint32_t> near_, later_, met_, before_;
    struct Pair {
        Vec3 normal, between; ///< of one plane; along it, away from the other
    };
    std::vector<Pair> pairs_;
    std::vector<Wall> walls_; ///< before the present piece
    SolidProof proof_;
    CancellationCounter asking_{64};
};

} // namespace

SolidProof prove_solid(const Solid& solid, const Elements& elements, bool all) {
    if (SolidAccess::data(solid).any_filled()) {
        return Cavities(solid, elements, all).run();
    }
    SolidProof none;
    none.holds = true;
    return none;
}

} // namespace foam::inline geometry
