// @stage@: every vertex moves towards the mean of its neighbours. A start: the method is to be yours.
#include <foam/sdk/plugin.hpp>

namespace {

using namespace foam;

class @class@ final : public MeshFilter {
public:
    explicit @class@(const Parameters& parameters) : share_(parameters.number("share")) {}

    Mesh apply(const Mesh& mesh, Context& context) const override {
        std::vector<Vec3> sum(mesh.vertices.size());
        std::vector<double> neighbours(mesh.vertices.size());
        context.check_cancelled();
        for (const Triangle& triangle : mesh.triangles) {
            for (std::size_t i = 0; i < 3; ++i) {
                sum[triangle[i]] += mesh.vertices[triangle[(i + 1) % 3]];
                ++neighbours[triangle[i]];
            }
        }
        Mesh result = mesh;
        for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
            if (neighbours[i] > 0) {
                result.vertices[i] += share_ * (sum[i] / neighbours[i] - mesh.vertices[i]);
            }
        }
        context.metric("volume_after", signed_volume(result), "m³"); // goes to the manifest
        return result;
    }

private:
    double share_;
};

} // namespace

FOAM_PLUGIN("@plugin@", "0.1", "Apache-2.0") {
    enrol.add<@class@>({
        .name = "@stage@",
        .summary = "Moves every vertex towards the mean of its neighbours",
        .reference = "",
        .parameters = {Parameter::number("share", 0.1)
                           .unit("1")
                           .bounds(0, 1)
                           .doc("Share of the way to the mean of the neighbours.")},
    });
}
