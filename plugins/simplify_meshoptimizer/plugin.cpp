// simplify.meshoptimizer: simplification by the library meshoptimizer, common in game engines.
#include <foam/base/error.hpp>
#include <foam/sdk/plugin.hpp>

#include <fmt/format.h>
#include <meshoptimizer.h>

#include <algorithm>
#include <cmath>

namespace {

using namespace foam;

void check(const Mesh& mesh) {
    if (mesh.triangles.empty()) {
        throw Error(ErrorCode::geometry, "the mesh has no triangles");
    }
    check_corners(mesh);
}

/// Returns the coordinates in the unit box: the library computes in single precision.
std::vector<float> unit_positions(const Mesh& mesh) {
    const Box box = bounds(mesh);
    const Vec3 center = box.center(), size = box.size();
    const double extent = std::max({size.x, size.y, size.z});
    if (!(extent > 0 && std::isfinite(extent))) {
        throw Error(ErrorCode::geometry, fmt::format("the mesh extends over {:g} m: nothing to simplify", extent));
    }
    std::vector<float> positions;
    positions.reserve(3 * mesh.vertices.size());
    for (const Vec3& p : mesh.vertices) {
        const Vec3 unit = (p - center) / extent;
        for (const double value : {unit.x, unit.y, unit.z}) {
            positions.push_back(
                static_cast<float>(std::isfinite(value) ? value : 0.0)); // unused vertices may have any value
        }
    }
    return positions;
}

class SimplifyMeshoptimizer final : public MeshFilter {
public:
    explicit SimplifyMeshoptimizer(const Parameters& parameters)
        : ratio_(parameters.number("ratio")), least_(static_cast<std::size_t>(parameters.integer("min_triangles"))),
          error_(static_cast<float>(parameters.number("max_error"))) {}

    Mesh apply(const Mesh& mesh, Context& context) const override {
        check(mesh);
        context.check_cancelled();
        const Topology before = topology(mesh);
        const auto share = static_cast<std::size_t>(std::ceil(ratio_ * static_cast<double>(mesh.triangles.size())));
        // The library may break a closed 2-manifold; then the reduction is smaller.
        for (std::size_t wanted = std::max(share, least_); wanted < mesh.triangles.size(); wanted *= 2) {
            context.check_cancelled();
            Mesh result = simplified(mesh, wanted);
            const Topology after = topology(result);
            const bool kept = !before.closed_manifold() ||
                              (after.closed_manifold() && signed_volume(result) * signed_volume(mesh) > 0);
            if (kept && !result.triangles.empty()) {
                return result;
            }
            context.log(Severity::info, fmt::format("{} triangles could not be had without breaking the mesh ({})",
                                                    wanted, describe(after)));
        }
        return mesh;
    }

private:
    Mesh simplified(const Mesh& mesh, std::size_t wanted) const {
        const std::vector<float> positions = unit_positions(mesh);
        std::vector<unsigned int> given, made(3 * mesh.triangles.size());
        given.reserve(made.size());
        for (const Triangle& t : mesh.triangles) {
            given.insert(given.end(), t.begin(), t.end());
        }
        made.resize(meshopt_simplify(made.data(), given.data(), given.size(), positions.data(), mesh.vertices.size(),
                                     3 * sizeof(float), 3 * wanted, error_, 0, nullptr));
        Mesh result{mesh.vertices, {}};
        for (std::size_t i = 0; i + 2 < made.size(); i += 3) {
            result.triangles.push_back({made[i], made[i + 1], made[i + 2]});
        }
        return welded(result);
    }

    double ratio_;
    std::size_t least_;
    float error_;
};

} // namespace

FOAM_PLUGIN("simplify_meshoptimizer", "1.0", "Apache-2.0") {
    enrol.add<SimplifyMeshoptimizer>(
        {.name = "simplify.meshoptimizer",
         .summary = "Collapses edges by the library meshoptimizer: vertices of the result are vertices of the input.",
         .reference =
             "Kapoulkine: meshoptimizer, https://github.com/zeux/meshoptimizer; error metric of Garland, Heckbert "
             "1997",
         .parameters = {
             Parameter::number("ratio", 0.2)
                 .unit("1")
                 .bounds(0.0001, 1)
                 .doc("Share of the triangles that is kept.")
                 .source("as simplify.quadric"),
             Parameter::integer("min_triangles", 800)
                 .unit("1")
                 .bounds(4, 100'000'000)
                 .doc("The ratio takes no mesh below this number.")
                 .source("as simplify.quadric"),
             Parameter::number("max_error", 0.01)
                 .unit("1")
                 .bounds(0, 1)
                 .doc("Largest error that the library allows itself, as a share of the mesh's extent: an estimate, no "
                      "proof.")
                 .source("the library's example, 1 %"),
         }});
}
