// What foam.model, foam.utility, foam.external and foam.bench stand on: single stages on meshes in memory.
#include "robot.hpp"

#include <foam/base/error.hpp>
#include <foam/base/parallel.hpp>
#include <foam/geometry/measure.hpp>
#include <foam/geometry/vector.hpp>
#include <foam/sdk/resource.hpp>
#include <foam/sdk/stage.hpp>

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <fmt/format.h>

#include <algorithm>

namespace foam::python {
namespace {

using Given = std::map<std::string, ParameterValue>;

/// How far each sphere protrudes from the solid, m: over 200 directions, where no other sphere covers it.
std::vector<double> protrusions(const Solid& solid, const std::vector<Sphere>& spheres) {
    const std::vector<Vec3> directions = fibonacci_directions(200);
    std::vector<double> far(spheres.size());
    parallel_for(spheres.size(), [&](std::size_t i) {
        const Sphere& sphere = spheres[i];
        for (const Vec3& direction : directions) {
            const Vec3 point = sphere.center + sphere.radius * direction;
            const bool exposed = std::none_of(spheres.begin(), spheres.end(), [&](const Sphere& other) {
                return &other != &sphere && distance(point, other.center) < other.radius;
            });
            if (exposed) {
                far[i] = std::max(far[i], solid.signed_distance(point));
            }
        }
    });
    return far;
}

/// The spheres of one level, grown to cover, with the mean, least and greatest protrusion.
py::tuple tuple_of_level(std::vector<Sphere> spheres, const std::vector<double>& far, bool certified) {
    double sum = 0, least = far.front(), most = 0;
    for (const double length : far) {
        sum += length;
        least = std::min(least, length);
        most = std::max(most, length);
    }
    return py::make_tuple(rows_of(std::move(spheres)), certified, sum / static_cast<double>(far.size()), least, most);
}

struct Level {
    std::vector<Sphere> spheres;
    std::vector<double> far;
    bool certified = false;
};

py::list levels_by(const HeldMesh& mesh, const HeldMesh* processed, const Registry& registry, const std::string& stage,
                   const Given& parameters, const std::vector<std::size_t>& counts, std::uint64_t seed) {
    const std::vector<Level> levels = worked([&](const Signals&) {
        const std::shared_ptr<const Solid> solid = mesh.solid();
        const Shape shape("mesh", processed ? processed->solid() : solid, solid);
        const auto spherizer = registry.make<Spherizer>(stage, parameters);
        QuietContext context(seed);
        std::vector<std::vector<Sphere>> found;
        if (counts.empty()) {
            for (SphereTree::Level& level : spherizer->spherize(shape, {}, context).levels) {
                found.push_back(std::move(level.elements.spheres()));
            }
        }
        for (const std::size_t count : counts) {
            const Budget budget{.max_spheres = count, .max_protrusion = {}, .guarantee = Guarantee::outer};
            found.push_back(spherizer->spherize(shape, budget, context).finest());
        }
        std::vector<Level> result;
        for (std::vector<Sphere>& spheres : found) {
            Level& level = result.emplace_back();
            level.spheres = grown_to_cover(*solid, std::move(spheres));
            std::erase_if(level.spheres, [](const Sphere& s) { return !(s.radius > 0); });
            level.certified = certify(*solid, level.spheres).holds;
            level.far = protrusions(*solid, level.spheres);
        }
        return result;
    });
    py::list list;
    for (const Level& level : levels) {
        list.append(tuple_of_level(level.spheres, level.far, level.certified));
    }
    return list;
}

/// Returns the mesh of a file by a loader with parameters.
std::shared_ptr<HeldMesh> loaded_by(const std::filesystem::path& file, const Registry& registry,
                                    const std::string& stage, const Given& parameters) {
    return worked([&](const Signals&) {
        QuietContext context;
        return std::make_shared<HeldMesh>(registry.make<MeshLoader>(stage, parameters)->load(file, context));
    });
}

/// Returns the number of elements by which a spherizer covers the mesh, grown and proved. `processed`: what it sees.
std::size_t covering(const HeldMesh& mesh, const HeldMesh* processed, const Registry& registry,
                     const std::string& stage, const Given& parameters, std::size_t count) {
    return worked([&](const Signals&) {
        const std::shared_ptr<const Solid> solid = mesh.solid();
        const Shape shape("mesh", processed ? processed->solid() : solid, solid);
        QuietContext context;
        const Budget budget{.max_spheres = count, .max_protrusion = {}, .guarantee = Guarantee::outer};
        SphereTree tree = registry.make<Spherizer>(stage, parameters)->spherize(shape, budget, context);
        const Elements grown = grown_to_cover(*solid, std::move(tree.levels.back().elements));
        if (!covers(*solid, grown)) {
            throw Error(ErrorCode::geometry, fmt::format("{} does not cover the mesh", stage));
        }
        return grown.size();
    });
}

} // namespace

void add_old(py::module_& module) {
    module.def("levels_by", &levels_by, py::arg("mesh"), py::arg("processed").none(true), py::arg("registry"),
               py::arg("stage"), py::arg("parameters"), py::arg("counts"), py::arg("seed"));
    module.def(
        "filtered",
        [](const HeldMesh& mesh, const Registry& registry, const std::string& stage, const Given& parameters) {
            return worked([&](const Signals&) {
                QuietContext context;
                return std::make_shared<HeldMesh>(
                    registry.make<MeshFilter>(stage, parameters)->apply(*mesh.mesh(), context));
            });
        },
        py::arg("mesh"), py::arg("registry"), py::arg("stage"), py::arg("parameters"));
    module.def("loaded", &loaded_by, py::arg("file"), py::arg("registry"), py::arg("stage"), py::arg("parameters"));
    module.def("covering", &covering, py::arg("mesh"), py::arg("processed").none(true), py::arg("registry"),
               py::arg("stage"), py::arg("parameters"), py::arg("count"));
    module.def(
        "resolve",
        [](const std::string& reference, const std::filesystem::path& base) {
            const ResolvedResource found = ResourceResolver::from_environment().resolve(reference, base);
            return py::make_tuple(found.path, found.tried);
        },
        py::arg("reference"), py::arg("base"));
}

} // namespace foam::python
