#include "promises.hpp"

#include <foam/base/error.hpp>
#include <foam/base/parallel.hpp>

namespace foam::inline runtime {
namespace {

std::vector<std::pair<std::string, Mesh>> meshes() {
    std::vector<std::pair<std::string, Mesh>> result;
    for (const auto& [name, make] : sample::solids()) {
        result.emplace_back(name, make()->surface());
    }
    return result;
}

/// Returns the filter's mesh; nothing if it refuses this one.
std::optional<Mesh> filtered(const MeshFilter& filter, const Mesh& mesh) {
    QuietContext context{3};
    try {
        return filter.apply(mesh, context);
    } catch (const Error& error) {
        require(error.code() == ErrorCode::geometry,
                fmt::format("it throws an error of the wrong code for a mesh: {}; remedy: ErrorCode::geometry",
                            error.what()));
        return {};
    }
}

void require_usable(const std::string& name, const Mesh& mesh) {
    require(!mesh.triangles.empty(), fmt::format("{}: it gives no triangle; remedy: throw Error(geometry)", name));
    for (const Vec3& p : mesh.vertices) {
        require(is_finite(p), fmt::format("{}: it gives a vertex that is not finite", name));
    }
    for (const Triangle& t : mesh.triangles) {
        for (const std::uint32_t corner : t) {
            require(corner < mesh.vertices.size(), fmt::format("{}: it gives a triangle with vertex {}, there are {}",
                                                               name, corner, mesh.vertices.size()));
        }
    }
}

std::vector<std::optional<Mesh>> all_filtered(const MeshFilter& filter,
                                              const std::vector<std::pair<std::string, Mesh>>& inputs) {
    std::vector<std::optional<Mesh>> results(inputs.size());
    parallel_for(inputs.size(), [&](std::size_t i) { results[i] = filtered(filter, inputs[i].second); });
    return results;
}

} // namespace

void check_mesh_filter(const MeshFilter& filter, Promises& promises) {
    const auto inputs = meshes();
    promises.check("gives usable meshes, or refuses", [&] {
        std::size_t refused = 0;
        for (const auto& [name, mesh] : inputs) {
            const std::optional<Mesh> result = filtered(filter, mesh);
            result ? require_usable(name, *result) : void(++refused);
        }
        require(refused < inputs.size(), "it refuses every mesh, even a box");
    });
    promises.check("keeps a closed box closed", [&] {
        const std::optional<Mesh> result = filtered(filter, sample::box({0.1, 0.2, 0.3}));
        require(result.has_value(), "it refuses a box");
        const Topology defects = topology(*result);
        require(defects.closed(), fmt::format("a box comes out with {}", describe(defects)));
    });
    promises.check("gives the same on any number of threads", [&] {
        std::array<std::vector<std::optional<Mesh>>, 2> results;
        with_threads(1, [&] { results[0] = all_filtered(filter, inputs); });
        with_threads(4, [&] { results[1] = all_filtered(filter, inputs); });
        for (std::size_t i = 0; i < inputs.size(); ++i) {
            require(results[0][i] == results[1][i],
                    fmt::format("{}: 4 threads give another mesh than 1; remedy: results into slots by index, no state "
                                "between calls",
                                inputs[i].first));
        }
    });
    promises.check("stops when asked", [&] {
        Mesh open = sample::torus(0.1, 0.03, 200, 100); // with a hole, so that repairs have work too
        open.triangles.resize(open.triangles.size() - 10);
        require_stop([&](Context& context) { filter.apply(open, context); });
    });
}

} // namespace foam::runtime
