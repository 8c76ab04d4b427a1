// Growth of elements until they cover a surface.
#include "convex/kind.hpp"
#include "proof/body_cuts.hpp"
#include "proof/element_proof.hpp"
#include "proof/filling.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/base/error.hpp>
#include <foam/geometry/measure.hpp>

namespace foam::inline geometry {
namespace {

constexpr std::uint32_t growth_cuts = 120;
/// Share of the growth for the whole part that an uncovered corner needs at least, so that one element gets the part.
constexpr double whole_part = 0.8;
/// Number of nearest elements that are compared by the volume they would add.
constexpr std::size_t compared_elements = 4;
/// Growth beyond what is uncovered, in slacks: elements that meet then overlap by enough for a proof.
constexpr double room_in_slacks = 8;

double twice_area(const Corners& t) {
    return norm(cross(t.b - t.a, t.c - t.a));
}

/// The points that each element is to contain, from the uncovered parts of a surface.
class Demands {
public:
    Demands(const Solid& solid, const std::vector<Element>& elements)
        : elements_(elements), pieces_(solid, {}, growth_cuts),
          bodies_(elements, solid.bounds().center(), pieces_.extent(), growth_cuts), cuts_(bodies_, growth_cuts),
          points_(elements.size()), looks_left_(20'000 + 20 * pieces_.piece_count()),
          smallest_(1e-8 * pieces_.extent()) {
        const OpenTriangles open(solid, elements, pieces_, bodies_);
        CancellationCounter asking(16);
        for (const std::uint32_t i : open.triangles()) {
            asking.check();
            look_at(pieces_.piece(i));
        }
    }

    const std::vector<Vec3>& of(std::size_t element) const { return points_[element]; }
    /// Returns whether there is nothing to contain: all parts are covered.
    bool none() const {
        return std::all_of(points_.begin(), points_.end(), [](const auto& points) { return points.empty(); });
    }
    double slack(std::uint32_t element) const { return bodies_.slack(element); }

private:
    void look_at(const Piece& piece) {
        constexpr std::size_t most_pieces = 2'000;
        if (piece.curved) {
            divide(piece);
            return;
        }
        Box box;
        for (const Vec3& p : PiecePoints(piece)) {
            box.add(p);
        }
        bodies_.meeting(box, candidates_);
        if (cuts_.cover(piece.corners, candidates_, smallest_, most_pieces)) {
            return;
        }
        for (const std::vector<Vec3>& polygon : cuts_.rest(piece.corners, candidates_, most_pieces)) {
            for (std::size_t k = 2; k < polygon.size(); ++k) {
                divide(
                    {.corners = {polygon[0], polygon[k - 1], polygon[k]}, .beneath = {}, .triangle = piece.triangle});
            }
        }
    }

    struct Waiting {
        Piece piece;
        std::size_t begin, end; ///< range in near_
    };

    /// Halves the piece until one element is to contain each open part.
    void divide(const Piece& whole) {
        near_.clear();
        for (std::uint32_t i = 0; i < bodies_.size(); ++i) {
            near_.push_back(i);
        }
        waiting_.assign(1, {whole, 0, near_.size()});
        while (!waiting_.empty()) {
            asking_.check();
            const Waiting next = waiting_.back();
            waiting_.pop_back();
            near_.resize(next.end);
            bodies_.choose_near(next.piece, next.begin, next.end, near_);
            const auto near = std::span(near_).subspan(next.end);
            const Bodies::Gap gap = bodies_.gap(next.piece, near);
            if (gap.held) {
                continue;
            }
            looks_left_ -= looks_left_ > 0;
            if (looks_left_ == 0 || gap.lower >= whole_part * gap.upper ||
                gap.upper <= std::max(bodies_.rounding(), smallest_ / 10) || size_of(next.piece) <= smallest_) {
                give(next.piece, near);
                continue;
            }
            const std::size_t end = near_.size();
            if (size_of(next.piece) > long_piece * gap.upper && divide_between(next.piece, next.end, end)) {
                continue;
            }
            const auto [first, second] = halves(next.piece);
            waiting_.push_back({second, next.end, end});
            waiting_.push_back({first, next.end, end});
        }
    }

    /// Queues the parts of a piece cut between two elements. Returns false if there are none. Not where boxes or hulls
    /// are near: rest() has cut along those, and their growth takes long to compute.
    bool divide_between(const Piece& piece, std::size_t begin, std::size_t end) {
        const auto near = std::span(near_).subspan(begin, end - begin);
        if (std::any_of(near.begin(), near.end(), [&](std::uint32_t i) { return !bodies_.planes(i).empty(); })) {
            return false;
        }
        const std::vector<Corners> parts =
            piece.curved ? std::vector<Corners>{} : cuts_.between_nearest(piece.corners, near);
        constexpr double most = 0.9; // share of a part: to cut beside a corner, again and again, would lead nowhere
        const double limit = most * twice_area(piece.corners);
        if (std::any_of(parts.begin(), parts.end(), [&](const Corners& part) { return twice_area(part) > limit; })) {
            return false;
        }
        for (const Corners& part : parts) {
            waiting_.push_back({BodyCuts::part_of(piece, part), begin, end});
        }
        return !parts.empty();
    }

    /// Gives the part to the element that adds the least volume.
    void give(const Piece& piece, std::span<const std::uint32_t> near) {
        std::vector<Vec3> corners;
        for (const Vec3& p : PiecePoints(piece)) {
            corners.push_back(pieces_.to_solid(p));
        }
        std::vector<std::pair<double, std::uint32_t>> order;
        for (const std::uint32_t i : near) {
            double growth = 0;
            for (const Vec3& p : PiecePoints(piece)) {
                growth = std::max(growth, bodies_.growth(i, p));
            }
            if (std::isfinite(growth)) {
                order.push_back({growth, i});
            }
        }
        std::sort(order.begin(), order.end());
        order.resize(std::min(order.size(), compared_elements));
        if (order.empty()) {
            return;
        }
        std::uint32_t best = order.front().second;
        double least = std::numeric_limits<double>::infinity();
        for (const auto& [growth, i] : order) {
            const double added = added_volume(elements_[i], corners);
            if (added < least) {
                least = added;
                best = i;
            }
        }
        points_[best].insert(points_[best].end(), corners.begin(), corners.end());
    }

    std::span<const Element> elements_;
    Balls pieces_;
    Bodies bodies_;
    BodyCuts cuts_;
    std::vector<std::vector<Vec3>> points_;
    CancellationCounter asking_{64};
    std::size_t looks_left_;
    double smallest_;
    std::vector<std::uint32_t> candidates_, near_;
    std::vector<Waiting> waiting_;
};

/// Enlarges an element to contain a ball or capsule of the solid if that takes less than the protrusion of the
/// polyhedron around it.
void grow_around_round_parts(const Solid& solid, std::vector<Element>& elements) {
    constexpr double tessellation = 0.005;
    const Balls pieces(solid, {}, growth_cuts);
    for (const RoundPart& part : pieces.round_parts()) {
        const Bodies bodies(elements, solid.bounds().center(), pieces.extent(), growth_cuts);
        double least = tessellation * part.radius;
        auto best = static_cast<std::uint32_t>(bodies.size());
        for (std::uint32_t i = 0; i < bodies.size(); ++i) {
            const double growth = std::max(bodies.depth(i, part.from), bodies.depth(i, part.to)) + part.radius;
            if (growth < least) {
                least = growth;
                best = i;
            }
        }
        if (least > 0 && best < bodies.size()) {
            const std::array ends{pieces.to_solid(part.from), pieces.to_solid(part.to)};
            elements[best] = enlarged(elements[best], ends, part.radius + room_in_slacks * bodies.slack(best));
        }
    }
}

/// Grows the elements that are valid.
void grow_all(std::vector<Element>& elements, double length) {
    for (Element& e : elements) {
        e = is_valid(e) ? grown(e, length) : e;
    }
}

/// Enlarges elements for what is uncovered.
void close_gaps(const Solid& solid, std::vector<Element>& elements) {
    constexpr int rounds = 16;
    for (int round = 0; round < rounds; ++round) {
        const Demands demands(solid, elements);
        if (demands.none()) {
            break;
        }
        for (std::uint32_t i = 0; i < elements.size(); ++i) {
            if (!demands.of(i).empty()) {
                elements[i] = enlarged(elements[i], demands.of(i), room_in_slacks * demands.slack(i));
            }
        }
    }
}

void grow_to_cover(const Solid& solid, std::vector<Element>& elements) {
    // Far from the origin an element may be thinner than the rounding, and then holds nothing for certain.
    for (const double share : {0.0, 1e-9, 1e-7, 1e-5, 1e-3}) {
        grow_all(elements, share * solid.bounds().diagonal());
        close_gaps(solid, elements);
        if (certify_surface(solid, elements).holds) {
            return;
        }
    }
    throw Error(ErrorCode::internal, "growth left a part of the surface uncovered");
}

} // namespace

Elements grown_to_cover(const Solid& solid, Elements given) {
    if (given.are_spheres()) {
        return grown_to_cover(solid, std::move(given.spheres()));
    }
    std::vector<Element> elements(given.begin(), given.end());
    if (std::none_of(elements.begin(), elements.end(), is_valid)) {
        throw Error(ErrorCode::geometry, "there is no valid element that could grow to cover the solid");
    }
    if (certify_surface(solid, given).holds) {
        return grown_to_fill(solid, std::move(given));
    }
    const Bodies bodies(given, solid.bounds().center(), solid.bounds().diagonal(), growth_cuts);
    for (std::uint32_t i = 0; i < elements.size(); ++i) { // rounding may be all that is missing
        elements[i] = is_valid(elements[i]) ? grown(elements[i], room_in_slacks * bodies.slack(i)) : elements[i];
    }
    if (!certify_surface(solid, elements).holds) {
        grow_around_round_parts(solid, elements);
        grow_to_cover(solid, elements);
    }
    return grown_to_fill(solid, elements);
}

} // namespace foam::geometry
