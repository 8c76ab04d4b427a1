// Only CGAL: this file takes long to compile.
#include "wrap.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/base/error.hpp>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/alpha_wrap_3.h>

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

} // namespace

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

} // namespace foam::repair
