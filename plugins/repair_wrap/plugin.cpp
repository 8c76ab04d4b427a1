// repair.wrap: a closed surface around any triangles.
#include "wrap.hpp"

#include <foam/base/error.hpp>
#include <foam/sdk/plugin.hpp>

#include <fmt/format.h>

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
