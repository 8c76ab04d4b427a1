#include "proof/element_proof.hpp"

#include "proof/body_cuts.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/geometry/measure.hpp>
#include <foam/geometry/internal/proof.hpp>

namespace foam::inline geometry {
namespace {

/// As for spheres (certificate.cpp): share of the extent below which pieces are not split, accuracy of the gap, and
/// limits on the number of pieces.
constexpr double smallest_open_piece = 1e-9, accuracy_of_gap = 1e-3;
constexpr std::size_t fewest_pieces = 1'000'000, pieces_of_triangle = 100, pieces_of_cuts = 20'000;

Box box_around(const Piece& piece) {
    Box box;
    for (const Vec3& p : PiecePoints(piece)) {
        box.add(p);
    }
    return box;
}

class ElementProof {
public:
    /// `gap`: finds the largest gap where the elements do not cover; else it stops at the first one.
    ElementProof(const Solid& solid, const Elements& elements, int depth, bool gap)
        : gap_(gap), shrink_(std::ldexp(1.0, -depth)), most_halvings_(static_cast<std::uint32_t>(3 * depth)),
          pieces_(solid, {}, most_halvings_),
          bodies_(elements, solid.bounds().center(), pieces_.extent(), most_halvings_),
          open_(solid, elements, pieces_, bodies_), cuts_(bodies_, most_halvings_),
          most_pieces_(fewest_pieces + pieces_of_triangle * pieces_.piece_count()) {}

    Certificate run() {
        certificate_.holds = true;
        certificate_.pieces = pieces_.piece_count() - open_.triangles().size();
        for (const std::uint32_t i : open_.triangles()) {
            asking_.check();
            examine(pieces_.piece(i));
            if (done()) {
                break;
            }
        }
        if (!certificate_.holds) {
            certificate_.growth = std::max(certificate_.growth, proved_gap_);
            certificate_.witness = pieces_.to_solid(certificate_.witness);
        }
        return certificate_;
    }

private:
    void examine(const Piece& piece) {
        ++certificate_.pieces;
        bodies_.meeting(box_around(piece), candidates_);
        smallest_ = std::max(smallest_open_piece * pieces_.extent(), shrink_ * size_of(piece));
        if (piece.curved) {
            halve(piece);
            return;
        }
        if (certificate_.pieces < most_pieces_) {
            const bool covered = cuts_.cover(piece.corners, candidates_, smallest_, pieces_of_cuts);
            certificate_.pieces += cuts_.pieces();
            if (covered) {
                return;
            }
        }
        for (const std::vector<Vec3>& polygon : cuts_.rest(piece.corners, candidates_, pieces_of_cuts)) {
            for (std::size_t k = 2; k < polygon.size(); ++k) {
                halve({.corners = {polygon[0], polygon[k - 1], polygon[k]},
                       .beneath = {},
                       .triangle = piece.triangle,
                       .level = BodyCuts::roundings * cuts_.most_cuts()});
            }
        }
    }

    struct Waiting {
        Piece piece;
        std::size_t begin, end; ///< range in near_ of the bodies that may be nearest to a point of the piece
    };

    /// Proves by halving alone, or finds the gap by branch and bound.
    void halve(const Piece& whole) {
        near_.clear();
        for (std::uint32_t i = 0; i < bodies_.size(); ++i) {
            near_.push_back(i);
        }
        waiting_.assign(1, {whole, 0, near_.size()});
        while (!waiting_.empty() && !done()) {
            asking_.check();
            const Waiting next = waiting_.back();
            waiting_.pop_back();
            near_.resize(next.end);
            ++certificate_.pieces;
            bodies_.choose_near(next.piece, next.begin, next.end, near_);
            bound({next.piece, next.end, near_.size()});
        }
    }

    /// Discards the piece if it is covered, too small to split, or not the worst; otherwise queues its halves.
    void bound(const Waiting& item) {
        const auto [held, lower, upper, farthest] =
            bodies_.gap(item.piece, std::span(near_).subspan(item.begin, item.end - item.begin));
        if (held) {
            return;
        }
        const PiecePoints corners(item.piece);
        if (lower > proved_gap_) {
            fail(item.piece, corners.points[farthest]);
            proved_gap_ = lower;
        }
        if (!certificate_.holds && upper <= std::max(certificate_.growth, proved_gap_)) {
            return;
        }
        // A gap as narrow as the smallest pieces, and long, would take any number of them.
        const bool small = size_of(item.piece) <= smallest_ || item.piece.level >= most_halvings_ ||
                           certificate_.pieces >= most_pieces_;
        if (small || !(upper - lower > accuracy_of_gap * upper) || upper <= smallest_) {
            fail(item.piece, corners.points[farthest]);
            certificate_.growth = upper; // more than before
            return;
        }
        if (size_of(item.piece) > long_piece * upper && divide_between(item)) {
            return;
        }
        const auto [first, second] = halves(item.piece);
        waiting_.push_back({second, item.begin, item.end});
        waiting_.push_back({first, item.begin, item.end});
    }

    /// Queues the parts of a piece cut between two elements. Returns false if there are none.
    bool divide_between(const Waiting& item) {
        const auto near = std::span(near_).subspan(item.begin, item.end - item.begin);
        const std::vector<Corners> parts =
            item.piece.curved ? std::vector<Corners>{} : cuts_.between_nearest(item.piece.corners, near);
        for (const Corners& part : parts) {
            waiting_.push_back({BodyCuts::part_of(item.piece, part), item.begin, item.end});
        }
        return !parts.empty();
    }

    void fail(const Piece& piece, const Vec3& witness) {
        certificate_.holds = false;
        certificate_.witness = witness;
        certificate_.triangle = piece.triangle;
    }

    /// Returns whether all that is to be found has been found.
    bool done() const { return !gap_ && !certificate_.holds; }

    CancellationCounter asking_{64};
    bool gap_;
    double shrink_;
    std::uint32_t most_halvings_;
    Balls pieces_;
    Bodies bodies_;
    OpenTriangles open_;
    BodyCuts cuts_;
    std::size_t most_pieces_;
    double smallest_ = 0, proved_gap_ = 0;
    Certificate certificate_;
    std::vector<std::uint32_t> candidates_, near_;
    std::vector<Waiting> waiting_;
};

} // namespace

bool contains_by_lengths(const Element& element, const Solid::Part& part) {
    if (!is_valid(element) || !part.primitive || !(element.pose == part.pose)) {
        return false;
    }
    const Element& inner = *part.primitive;
    const bool wider = element.radius >= inner.radius, longer = element.half.z >= inner.half.z,
               larger = longer && element.half.x >= inner.half.x && element.half.y >= inner.half.y;
    using Kind = Element::Kind;
    if (element.kind == inner.kind) {
        return inner.kind != Kind::hull && wider && larger;
    }
    switch (inner.kind) {
    case Kind::sphere:
        return element.kind != Kind::hull &&
               (element.kind == Kind::cylinder
                    ? element.half.z >= inner.radius && wider
                    : wider || std::min({element.half.x, element.half.y, element.half.z}) >= inner.radius);
    case Kind::capsule:
        return element.kind == Kind::swept_box && wider && longer;
    case Kind::cylinder:
        return element.kind == Kind::capsule && wider && longer;
    case Kind::box:
        return element.kind == Kind::swept_box && larger;
    case Kind::swept_box:
    case Kind::hull:
    case Kind::ellipsoid:
        break;
    }
    return false;
}

OpenTriangles::OpenTriangles(const Solid& solid, const Elements& elements, const Balls& pieces,
                             const Bodies& bodies) {
    find_contained_parts(solid, elements, pieces, bodies);
    find_holders(solid, bodies);
    CancellationCounter asking(256);
    for (std::uint32_t t = 0; t < pieces.piece_count(); ++t) {
        if (!contained_.empty() && contained_[t]) {
            continue;
        }
        asking.check();
        if (!held_by_one(solid.surface().triangles[t], pieces, bodies, t)) {
            open_.push_back(t);
        }
    }
}

/// Finds the bodies that hold each vertex. The vertex relative to the centre is that of the pieces.
void OpenTriangles::find_holders(const Solid& solid, const Bodies& bodies) {
    const Vec3 origin = solid.bounds().center();
    ends_.reserve(solid.surface().vertices.size());
    CancellationCounter asking(256);
    for (const Vec3& v : solid.surface().vertices) {
        asking.check();
        bodies.holders(v - origin, [&](std::uint32_t i) { holders_.push_back(i); });
        ends_.push_back(holders_.size());
    }
}

bool OpenTriangles::held_by_one(const Triangle& triangle, const Balls& pieces, const Bodies& bodies,
                                std::uint32_t t) const {
    const auto of = [&](std::uint32_t vertex) {
        const std::size_t begin = vertex == 0 ? 0 : ends_[vertex - 1];
        return std::span(holders_).subspan(begin, ends_[vertex] - begin);
    };
    const auto among = [](std::uint32_t i, std::span<const std::uint32_t> list) {
        return std::find(list.begin(), list.end(), i) != list.end();
    };
    const auto [a, b, c] = triangle;
    for (const std::uint32_t i : of(a)) {
        if (among(i, of(b)) && among(i, of(c))) {
            const Piece piece = pieces.piece(t);
            if (!piece.curved || bodies.holds(i, piece)) {
                return true;
            }
        }
    }
    return false;
}

void OpenTriangles::find_contained_parts(const Solid& solid, const Elements& elements, const Balls& pieces,
                                         const Bodies& bodies) {
    const auto contained = [&](std::uint32_t begin, std::uint32_t end) {
        contained_.resize(pieces.piece_count(), 0);
        std::fill(contained_.begin() + begin, contained_.begin() + end, 1);
    };
    for (const RoundPart& part : pieces.round_parts()) {
        for (std::uint32_t i = 0; i < bodies.size(); ++i) {
            if (bodies.holds(i, part)) {
                contained(part.begin, part.end);
                break;
            }
        }
    }
    for (std::size_t i = 0; i < solid.parts().size(); ++i) {
        const Solid::Part& part = solid.parts()[i];
        if (part.primitive && std::any_of(elements.shaped().begin(), elements.shaped().end(),
                                          [&](const Element& e) { return contains_by_lengths(e, part); })) {
            contained(solid.part_offsets()[i], solid.part_offsets()[i + 1]);
        }
    }
}

/// Adds the proof that the elements leave no cavity to that of the surface.
static void prove_inside(const Solid& solid, const Elements& elements, Certificate& certificate) {
    certificate.covers = solid.covers();
    if (!certificate.holds) {
        return;
    }
    const SolidProof inside = prove_solid(solid, elements);
    if (!inside.holds) {
        certificate.holds = false;
        certificate.cavity = true;
        certificate.growth = inside.depth;
        certificate.witness = inside.witness;
    }
}

CoverProof prove_cover(const Solid& solid, const Elements& elements, int depth) {
    CoverProof proof;
    if (elements.are_spheres()) {
        proof = prove_cover_by_spheres(solid, elements.spheres(), depth);
    } else {
        proof = {.certificate = ElementProof(solid, elements, std::clamp(depth, 0, 60), true).run(),
                 .triangles = solid.surface().triangles.size()};
    }
    prove_inside(solid, elements, proof.certificate);
    return proof;
}

Certificate certify(const Solid& solid, const Elements& elements, int depth) {
    return prove_cover(solid, elements, depth).certificate;
}

Certificate certify_surface(const Solid& solid, const Elements& elements) {
    constexpr int depth = 40;
    if (elements.are_spheres()) {
        return prove_cover_by_spheres(solid, elements.spheres(), depth).certificate;
    }
    return ElementProof(solid, elements, depth, false).run();
}

Certificate certify_to_first_gap(const Solid& solid, const Elements& elements) {
    Certificate certificate = certify_surface(solid, elements);
    prove_inside(solid, elements, certificate);
    return certificate;
}

bool covers(const Solid& solid, const Elements& elements) {
    return certify_to_first_gap(solid, elements).holds;
}

} // namespace foam::geometry
