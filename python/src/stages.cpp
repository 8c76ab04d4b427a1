#include "stages.hpp"

#include "mesh.hpp"
#include "own_stages.hpp"
#include "work.hpp"

#include <foam/base/error.hpp>
#include <foam/judge/evaluate.hpp>
#include <foam/sdk/registry.hpp>

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <fmt/format.h>

namespace foam::python {
namespace {

std::shared_ptr<Registry> loaded(const std::vector<std::filesystem::path>& folders) {
    return worked([&](const Signals&) {
        auto registry = std::make_shared<Registry>();
        for (const std::filesystem::path& folder : plugin_directories(folders)) {
            registry->load_directory(folder);
        }
        if (has_own_stages()) {
            const PluginRecord& record = registry->load(own_file());
            if (!record.loaded()) {
                throw Error(ErrorCode::plugin, fmt::format("the stages of Python are refused: {}", record.rejection));
            }
        }
        return registry;
    });
}

std::shared_ptr<HeldMesh> mesh_from(const std::filesystem::path& file, const Registry& registry,
                                    const std::optional<std::string>& unit, double scale) {
    return worked([&](const Signals&) {
        if (!registry.find_for_extension(StageKind::mesh_loader,
                                         file.extension().string().substr(file.has_extension()))) {
            throw Error(ErrorCode::usage,
                        fmt::format("{}: files of type '{}' are not read as meshes; remedy: foam.load() "
                                    "reads robots",
                                    file.string(), file.extension().string()));
        }
        const Original original = load_original(file, registry, {.unit = {.unit = unit, .scale = scale}});
        return std::make_shared<HeldMesh>(original.links[0].solid);
    });
}

} // namespace

void add_stages(py::module_& module) {
    py::class_<Registry, std::shared_ptr<Registry>>(module, "Registry").def(py::init(&loaded), py::arg("folders"));
    module.def("load_mesh", &mesh_from, py::arg("file"), py::arg("registry"), py::arg("unit"), py::arg("scale"));
}

} // namespace foam::python
