#include "search.hpp"

#include <algorithm>
#include <numbers>

namespace judge {
namespace {

/// Pieces are cut in four until they are no larger than the smallest element near them, but not without end.
constexpr int most_cuts = 4;

bool small_enough(const Search& search, Real reach, int cuts) {
    Real smallest = std::numeric_limits<Real>::infinity();
    for (const Body* element : search.elements()) {
        smallest = std::min(smallest, element->reach);
    }
    return reach <= smallest || cuts >= most_cuts;
}

/// A triangle within one element needs no points: elements are convex.
bool in_one(const Search& search, const Corners& corners) {
    return std::any_of(search.elements().begin(), search.elements().end(), [&](const Body* element) {
        return std::all_of(corners.begin(), corners.end(), [&](const Point& p) { return depth(*element, p, 0) <= 0; });
    });
}

Patch patch_of(const Corners& c) {
    Patch patch;
    patch.at = [c](Real s, Real t) { return c[0] + s * (c[1] - c[0]) + t * (c[2] - c[0]); };
    patch.triangle = true;
    patch.middle = patch.at(1 / Real{3}, 1 / Real{3});
    for (const Point& p : c) {
        patch.reach = std::max(patch.reach, length(p - patch.middle));
    }
    return patch;
}

void ask_triangle(Search& search, const Corners& c, int cuts = 0) {
    const Patch patch = patch_of(c);
    Search near = search.near(patch.middle, patch.reach);
    if (in_one(near, c)) {
        return;
    }
    if (!small_enough(near, patch.reach, cuts)) {
        const Point a = 0.5L * (c[1] + c[2]), b = 0.5L * (c[2] + c[0]), d = 0.5L * (c[0] + c[1]);
        for (const Corners& part : {Corners{c[0], d, b}, {d, c[1], a}, {b, a, c[2]}, {a, b, d}}) {
            ask_triangle(near, part, cuts + 1);
        }
    } else {
        ask_patch(near, patch);
        ask_leaving(near, c);
    }
    search.ask(near);
}

/// A piece of a round surface: turned about the axis and led along the profile from one share to another.
struct Turned {
    const Part& part;
    enum class Profile { side, end, cap } profile;
    Real sign; ///< which end or cap
    Real turn, turns, from, to;

    Point at(Real s, Real t) const {
        const Real angle = 2 * std::numbers::pi_v<Real> * (turn + s * turns), share = from + t * (to - from);
        const Real polar = share * std::numbers::pi_v<Real> / 2;
        const Real across = profile == Profile::side  ? part.radius
                            : profile == Profile::end ? share * part.radius
                                                      : part.radius * std::sin(polar);
        const Real along = profile == Profile::side  ? (share - 0.5L) * part.length
                           : profile == Profile::end ? sign * part.length / 2
                                                     : sign * (part.length / 2 + part.radius * std::cos(polar));
        return part.center + across * std::cos(angle) * part.across + across * std::sin(angle) * part.up +
               along * part.axis;
    }
    Patch patch() const {
        const Real pi = std::numbers::pi_v<Real>;
        const Real along = (to - from) * (profile == Profile::side  ? part.length
                                          : profile == Profile::end ? part.radius
                                                                    : part.radius * pi / 2);
        return {[*this](Real s, Real t) { return at(s, t); }, false, at(0.5L, 0.5L),
                std::hypot(pi * turns * part.radius, along / 2) * (1 + 1e-9L)};
    }
};

void ask_turned(Search& search, const Turned& piece, int cuts = 0) {
    const Patch patch = piece.patch();
    Search near = search.near(patch.middle, patch.reach);
    if (near.ask(patch.middle) <= -patch.reach) {
        return; // a ball around the piece is in one element
    }
    if (!small_enough(near, patch.reach, cuts)) {
        const Real half = piece.turns / 2, middle = (piece.from + piece.to) / 2;
        for (const Real turn : {piece.turn, piece.turn + half}) {
            ask_turned(near, {piece.part, piece.profile, piece.sign, turn, half, piece.from, middle}, cuts + 1);
            ask_turned(near, {piece.part, piece.profile, piece.sign, turn, half, middle, piece.to}, cuts + 1);
        }
    } else {
        ask_patch(near, patch);
    }
    search.ask(near);
}

void ask_round(Search& search, const Part& part) {
    constexpr int pieces = 12;
    using Profile = Turned::Profile;
    const Profile end = part.kind == Part::Kind::cylinder ? Profile::end : Profile::cap;
    for (int k = 0; k < pieces; ++k) {
        const Real turn = static_cast<Real>(k) / pieces, turns = Real{1} / pieces;
        ask_turned(search, {part, end, -1, turn, turns, 0, 1});
        ask_turned(search, {part, end, 1, turn, turns, 0, 1});
        if (part.length > 0) {
            ask_turned(search, {part, Profile::side, 0, turn, turns, 0, 1});
        }
    }
}

} // namespace

std::optional<Objection> outside_of_elements(const Link& link, const std::vector<Body>& elements) {
    std::optional<Objection> worst;
    for (const Part& part : link.parts) {
        Search search(elements, part.rounding);
        if (part.kind != Part::Kind::mesh) {
            ask_round(search, part);
        }
        for (const Corners& corners : part.triangles) {
            ask_triangle(search, corners);
        }
        if (search.worst() && (!worst || search.worst()->distance > worst->distance)) {
            worst = search.worst();
        }
    }
    return worst;
}

std::optional<Objection> outside_of_balls(const Link& link, const std::vector<Ball>& balls) {
    std::vector<Body> elements;
    for (const Ball& ball : balls) {
        elements.push_back(ball_at(ball.center, ball.radius));
    }
    return outside_of_elements(link, elements);
}

} // namespace judge
