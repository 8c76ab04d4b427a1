// Hulls: polytopes.
#include "convex/kind.hpp"
#include "convex/polytope.hpp"

#include <array>
#include <limits>

namespace foam::inline geometry {
namespace {

constexpr double without_end = std::numeric_limits<double>::infinity();

MaybePart in_hull(const Vec3& o, const Vec3& d, const Polytope& hull) {
    LinePart part{-without_end, without_end};
    for (const Polytope::Face& face : hull.faces) {
        const double slope = dot(face.normal, d), room = face.offset - dot(face.normal, o);
        if (slope > 0) {
            part.leave = std::min(part.leave, room / slope);
        } else if (slope < 0) {
            part.enter = std::max(part.enter, room / slope);
        } else if (room < 0) {
            return {};
        }
    }
    return part.enter < part.leave ? MaybePart(part) : MaybePart();
}

void add_hull_patches(const Mesh& mesh, std::vector<Patch>& patches) {
    for (const auto& [ia, ib, ic] : mesh.triangles) {
        const Vec3 a = mesh.vertices[ia], u = mesh.vertices[ib] - a, v = mesh.vertices[ic] - a, n = cross(u, v);
        patches.push_back({norm(n) / 2, [=](double s, double t) {
                               const double root = std::sqrt(s);
                               return ElementPoint{a + u * (root * (1 - t)) + v * (root * t), normalized(n), 0};
                           }});
    }
}

Element hull_around(Element e, std::span<const Vec3> points, double room) {
    const Polytope& hull = *e.hull;
    std::vector<double> lengths(hull.faces.size(), 0.0);
    std::vector<Vec3> own, all = hull.surface.vertices;
    for (const Vec3& p : points) {
        own.push_back(to_own_frame(e, p));
    }
    for (std::size_t f = 0; f < hull.faces.size(); ++f) {
        for (const Vec3& p : own) {
            lengths[f] = std::max(lengths[f], dot(hull.faces[f].normal, p) - hull.faces[f].offset);
        }
        lengths[f] += room;
    }
    all.insert(all.end(), own.begin(), own.end());
    const auto with_points = convex_hull(all);
    const auto moved = with_faces_moved(hull, lengths, own, room);
    e.hull = moved;
    if (!moved || with_points->surface.vertices.size() <= hull.surface.vertices.size()) {
        const auto wider = with_room(*with_points, room);
        e.hull = !moved || signed_volume(wider->surface) < signed_volume(moved->surface) ? wider : moved;
    }
    return e;
}

class HullKind final : public ConvexKind {
public:
    using ConvexKind::ConvexKind;

    double signed_distance(const Element& e, const Vec3& p) const override {
        double farthest = -without_end;
        for (const Polytope::Face& face : e.hull->faces) {
            farthest = std::max(farthest, dot(face.normal, p) - face.offset);
        }
        return farthest;
    }
    Vec3 support(const Element& e, const Vec3& d) const override {
        Vec3 best = e.hull->surface.vertices.front();
        double farthest = dot(best, d);
        for (const Vec3& v : e.hull->surface.vertices) {
            const double far = dot(v, d);
            if (far > farthest) {
                farthest = far;
                best = v;
            }
        }
        return best;
    }
    Box bounds(const Element& e) const override {
        Box box;
        for (const Vec3& v : e.hull->surface.vertices) {
            box.add(e.pose * v);
        }
        return box;
    }
    double volume(const Element& e) const override { return signed_volume(e.hull->surface); }
    MaybePart inside_along(const Element& e, const Vec3& o, const Vec3& d) const override {
        return in_hull(o, d, *e.hull);
    }
    Mesh mesh(const Element& e, int) const override { return e.hull->surface; }
    bool has_flat_faces() const override { return true; }
    std::vector<ElementPoint> surface_points(const Element& e, std::size_t count) const override {
        const Mesh& mesh = e.hull->surface;
        std::vector<Patch> patches;
        add_hull_patches(mesh, patches);
        std::vector<ElementPoint> points;
        add_points(patches, area_of(patches), count, points);
        Vec3 middle{};
        for (const Vec3& v : mesh.vertices) {
            middle += v / static_cast<double>(mesh.vertices.size());
        }
        for (const Vec3& v : mesh.vertices) {
            points.push_back({v, normalized(v - middle), 0});
        }
        return points;
    }
    Element grown(Element e, double length, double (*)(double, double)) const override {
        e.hull = with_room(*e.hull, length);
        return e;
    }
    Element enlarged(const Element& e, std::span<const Vec3> points, double room) const override {
        return hull_around(e, points, room);
    }
    double added_volume(const Element& e, std::span<const Vec3> points) const override {
        // The pyramids from a point to the triangles that it sees.
        const Mesh& mesh = e.hull->surface;
        double most = 0;
        for (const Vec3& p : points) {
            const Vec3 q = to_own_frame(e, p);
            double sum = 0;
            for (const auto& [a, b, c] : mesh.triangles) {
                const Vec3& at = mesh.vertices[a];
                sum += std::max(0.0, dot(cross(mesh.vertices[b] - at, mesh.vertices[c] - at), q - at));
            }
            most = std::max(most, sum / 6);
        }
        return most;
    }
};

constexpr std::array<std::string_view, 1> of_hull{"vertices"};
constexpr HullKind hull("hull", of_hull);

} // namespace

extern constinit const ConvexKind* const hull_kind = &hull;

} // namespace foam::inline geometry
