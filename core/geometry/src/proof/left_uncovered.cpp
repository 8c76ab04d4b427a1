#include <foam/geometry/internal/proof.hpp>

#include "proof/element_proof.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/geometry/internal/triangles.hpp>
#include <foam/geometry/measure.hpp>
#include <foam/geometry/solid.hpp>

#include <algorithm>

namespace foam::inline geometry {
namespace {

class Cutting {
public:
    Cutting(const std::vector<Sphere>& spheres, double size) : smallest_(size / 500) {
        for (const Sphere& s : spheres) {
            if (const double radius = s.radius - 1e-9 * size; radius > 0) {
                spheres_.push_back({s.center, radius});
            }
        }
    }

    void add(const Corners& t) {
        asking_.check();
        const auto holds_all = [&](const Sphere& s) { return holds(s, t.a) && holds(s, t.b) && holds(s, t.c); };
        if (std::any_of(spheres_.begin(), spheres_.end(), holds_all)) {
            return;
        }
        const auto meets = [&](const Sphere& s) { return holds(s, closest_on_triangle(t, s.center)); };
        if (std::none_of(spheres_.begin(), spheres_.end(), meets)) {
            return leave(t);
        }
        const double ab = distance(t.a, t.b), bc = distance(t.b, t.c), ca = distance(t.c, t.a);
        const double longest = std::max({ab, bc, ca});
        if (longest <= smallest_) {
            return covered_together(t) ? void() : leave(t);
        }
        // The longest edge is halved (Rivara 1984), so that the angles stay bounded.
        const Corners r = longest == ab ? t : longest == bc ? Corners{t.b, t.c, t.a} : Corners{t.c, t.a, t.b};
        const Vec3 middle = (r.a + r.b) * 0.5;
        add({r.a, middle, r.c});
        add({middle, r.b, r.c});
    }

    Mesh left;

private:
    static bool holds(const Sphere& s, const Vec3& p) { return distance(s.center, p) <= s.radius; }

    void leave(const Corners& t) {
        const auto first = static_cast<std::uint32_t>(left.vertices.size());
        left.vertices.insert(left.vertices.end(), {t.a, t.b, t.c});
        left.triangles.push_back({first, first + 1, first + 2});
    }

    /// Returns whether the spheres are proved to cover a piece that no single sphere covers.
    bool covered_together(const Corners& t) const {
        for (const Vec3& corner : {t.a, t.b, t.c}) {
            if (std::none_of(spheres_.begin(), spheres_.end(), [&](const Sphere& s) { return holds(s, corner); })) {
                return false;
            }
        }
        constexpr int depth = 40;
        return prove_cover_by_spheres(*Solid::make(Mesh{{t.a, t.b, t.c}, {{0, 1, 2}}}), spheres_, depth).certificate.holds;
    }

    double smallest_;
    std::vector<Sphere> spheres_;
    CancellationCounter asking_{1024};
};

} // namespace

Mesh left_uncovered(const Mesh& surface, const std::vector<Sphere>& spheres) {
    if (spheres.empty()) {
        return surface;
    }
    Cutting cutting(spheres, bounds(surface).diagonal());
    for (const Triangle& t : surface.triangles) {
        cutting.add({surface.vertices[t[0]], surface.vertices[t[1]], surface.vertices[t[2]]});
    }
    return welded(cutting.left);
}

} // namespace foam::inline geometry
