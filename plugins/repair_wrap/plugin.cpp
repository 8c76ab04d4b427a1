// repair.wrap: a closed surface around any triangles.
#include <foam/sdk/plugin.hpp>

#include <foam/base/cancellation.hpp>
#include <foam/base/error.hpp>
#include <foam/geometry/mesh.hpp>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/alpha_wrap_3.h>
#include <fmt/format.h>

#include <algorithm>

namespace foam::repair {

namespace {

/// Ends the wrapping on request, and where it makes no progress. CGAL 5.5 inserts one point again and again where needles
/// meet and rounding puts the next point on one that is there.
struct WatchingVisitor : CGAL::Alpha_wraps_3::internal::Wrapping_default_visitor {
    static constexpr int most_repeated = 1000;

    template <class Wrapper, class Gate> void before_facet_treatment(const Wrapper&, const Gate&) { check_cancelled(); }
    template <class Wrapper, class Vertex> void after_Steiner_point_insertion(const Wrapper& wrapper, Vertex) {
        const std::size_t now = wrapper.triangulation().number_of_vertices();
        repeated = now == vertices ? repeated + 1 : 0;
        vertices = now;
        if (repeated > most_repeated) {
            throw Error(ErrorCode::geometry, "the wrap cannot go on: CGAL inserts the same point again and again, as "
                                             "where needles meet; remedy: a larger offset");
        }
    }

    std::size_t vertices = 0;
    int repeated = 0;
};

/// Returns the closed surface that shrink-wraps the triangles at distance `offset`, entering openings wider than
/// `alpha`. Portaneri, Rouxel-Labbé, Hemmer, Cohen-Steiner, Alliez: Alpha Wrapping with an Offset, SIGGRAPH 2022;
/// encloses the input. Preconditions: finite vertices, indices in range, alpha and offset above 0, in the mesh's unit.
Mesh alpha_wrap(const Mesh& mesh, double alpha, double offset) {
    using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
    std::vector<Kernel::Point_3> points;
    points.reserve(mesh.vertices.size());
    for (const Vec3& p : mesh.vertices) {
        points.emplace_back(p.x, p.y, p.z);
    }
    std::vector<std::array<std::size_t, 3>> faces;
    faces.reserve(mesh.triangles.size());
    for (const auto& [a, b, c] : mesh.triangles) {
        faces.push_back({a, b, c});
    }
    const auto has_area = [&](const std::array<std::size_t, 3>& face) {
        return !CGAL::collinear(points[face[0]], points[face[1]], points[face[2]]);
    };
    if (std::none_of(faces.begin(), faces.end(), has_area)) { // the library skips the others and needs one
        throw Error(ErrorCode::geometry, "the mesh has no triangle with an area: there is nothing to wrap");
    }
    CGAL::Surface_mesh<Kernel::Point_3> wrapped;
    WatchingVisitor visitor;
    CGAL::alpha_wrap_3(points, faces, alpha, offset, wrapped, CGAL::parameters::default_values(),
                       CGAL::parameters::visitor(visitor));
    Mesh result;
    result.vertices.reserve(wrapped.number_of_vertices());
    for (const auto vertex : wrapped.vertices()) { // no vertex is removed: their numbers have no gaps
        const Kernel::Point_3& p = wrapped.point(vertex);
        result.vertices.push_back({p.x(), p.y(), p.z()});
    }
    for (const auto face : wrapped.faces()) {
        Triangle triangle{};
        std::size_t k = 0;
        for (const auto vertex : wrapped.vertices_around_face(wrapped.halfedge(face))) {
            triangle[k++] = vertex;
        }
        result.triangles.push_back(triangle);
    }
    return result;
}

} // namespace

} // namespace foam::repair

namespace {

using namespace foam;

class Wrap final : public MeshFilter {
public:
    explicit Wrap(const Parameters& parameters)
        : alpha_(parameters.number("alpha")), offset_(parameters.number("offset")) {}

    Mesh apply(const Mesh& mesh, Context& context) const override {
        check_corners(mesh);
        context.check_cancelled();
        const Mesh input = welded(mesh);
        const Box box = bounds(input);
        const double diagonal = box.diagonal();
        if (input.triangles.empty() || !(diagonal > 1e-90 && diagonal < 1e90)) {
            throw Error(ErrorCode::geometry,
                        fmt::format("the mesh has no surface to wrap ({} triangles{})", input.triangles.size(),
                                    input.triangles.empty() ? "" : ", and no size to compute with"));
        }
        Mesh result = in_unit_box(input, box.center(), 1 / diagonal);
        result = repair::alpha_wrap(result, alpha_, offset_);
        result = in_unit_box(result, -box.center() / diagonal, diagonal);
        const Topology defects = topology(result);
        if (!defects.closed_manifold() || !(signed_volume(result) > 0)) {
            throw Error(ErrorCode::geometry,
                        fmt::format("the wrap is not closed ({}); remedy: another alpha", describe(defects)));
        }
        return result;
    }

private:
    /// Returns (p - center) * scale, so that the library's numbers neither overflow nor vanish.
    static Mesh in_unit_box(Mesh mesh, const Vec3& center, double scale) {
        for (Vec3& p : mesh.vertices) {
            p = (p - center) * scale;
        }
        return mesh;
    }

    double alpha_, offset_;
};

} // namespace

FOAM_PLUGIN("repair_wrap", "1.0", "GPL-3.0-or-later") {
    enrol.add<Wrap>(
        {.name = "repair.wrap",
         .summary = "Shrink-wraps anything: a closed surface that encloses the input at a small distance.",
         .reference = "Portaneri, Rouxel-Labbé, Hemmer, Cohen-Steiner, Alliez: Alpha Wrapping with an Offset, SIGGRAPH "
                      "2022, by CGAL",
         .parameters = {
             Parameter::number("alpha", 0.05)
                 .unit("1")
                 .bounds(0.002, 1)
                 .doc("The wrap enters openings wider than this, and loses hollows narrower than it: share of the "
                      "bounding box's diagonal.")
                 .source("a twentieth, as in CGAL's examples; time grows with the square of 1 / alpha"),
             Parameter::number("offset", 0.001)
                 .unit("1")
                 .bounds(0.0001, 0.1)
                 .doc("Distance of the wrap from the input: share of the bounding box's diagonal.")
                 .source("a fiftieth of alpha; CGAL's examples have alpha / 30"),
         }});
}
