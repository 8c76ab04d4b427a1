#include "module.hpp"

#include "robot.hpp"
#include "work.hpp"

#include <foam/base/error.hpp>
#include <foam/judge/evaluate.hpp>
#include <foam/sdk/plugin.hpp>
#include <foam/sdk/registry.hpp>
#include <foam/sdk/stage.hpp>

#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <dlfcn.h>

#include <map>
#include <mutex>

namespace foam::python {
namespace {

/// A spherizer as Python declared it.
struct OwnStage {
    StageInfo info;
    py::object function;
};

/// All of them by name. It is left to the end of the process: registries may outlive the interpreter.
std::map<std::string, OwnStage>& own_stages() {
    static auto* const stages = new std::map<std::string, OwnStage>;
    return *stages;
}

std::shared_ptr<HeldMesh> mesh_of(const Solid& solid) {
    return std::make_shared<HeldMesh>(Mesh(solid.surface()));
}

py::object value_of(const ParameterValue& value) {
    return std::visit([](const auto& v) -> py::object { return py::cast(v); }, value);
}

/// Calls a function of Python, one call at a time: it needs the interpreter's lock.
class PythonSpherizer final : public Spherizer {
public:
    PythonSpherizer(const PyObject* function, Parameters parameters)
        : function_(const_cast<PyObject*>(function)), parameters_(std::move(parameters)) {}

    SphereTree spherize(const Shape& shape, const Budget& budget, Context& context) const override {
        const py::gil_scoped_acquire lock;
        try {
            py::dict given;
            for (const auto& [name, value] : parameters_.values()) {
                given[py::str(name)] = value_of(value);
            }
            const py::object rows =
                py::module_::import("foam._own_stages")
                    .attr("call")(py::handle(function_), shape.name(), mesh_of(shape.original()),
                                  mesh_of(shape.processed()), budget.max_spheres, budget.max_protrusion,
                                  guarantee_of(budget), context.seed(), given);
            return flat_tree(spheres_of(rows.cast<py::buffer>()));
        } catch (const py::error_already_set& error) {
            throw Error(ErrorCode::geometry, error.what()); // the object of Python stays behind
        }
    }

private:
    static const char* guarantee_of(const Budget& budget) {
        return budget.guarantee == Guarantee::outer   ? "outer"
               : budget.guarantee == Guarantee::inner ? "inner"
                                                      : "fitted";
    }

    PyObject* function_;
    Parameters parameters_;
};

Parameter parameter_of(const std::string& name, const py::object& value) {
    if (py::isinstance<py::bool_>(value)) {
        return Parameter::boolean(name, value.cast<bool>());
    }
    if (py::isinstance<py::int_>(value)) {
        return Parameter::integer(name, value.cast<std::int64_t>());
    }
    if (py::isinstance<py::float_>(value)) {
        return Parameter::number(name, value.cast<double>());
    }
    return Parameter::text(name, value.cast<std::string>());
}

void declare(const std::string& name, const std::string& summary, const py::object& function, bool original_only,
             int revision, const std::map<std::string, py::object>& parameters) {
    OwnStage stage;
    stage.info = {.name = name, .summary = summary, .revision = revision};
    stage.info.original_only = original_only;
    for (const auto& [key, value] : parameters) {
        stage.info.parameters.push_back(parameter_of(key, value).doc("A parameter of a function of Python."));
    }
    stage.function = function;
    // A function that is replaced stays: a registry may still call it.
    if (const auto before = own_stages().find(name); before != own_stages().end()) {
        before->second.function.release();
    }
    own_stages().insert_or_assign(name, std::move(stage));
}

} // namespace

std::string own_file() {
    Dl_info info{};
    return dladdr(reinterpret_cast<const void*>(&own_file), &info) != 0 && info.dli_fname ? info.dli_fname : "";
}

bool has_own_stages() {
    return !own_stages().empty();
}

void add_own_stages(py::module_& module) {
    module.def("declare_spherizer", &declare, py::arg("name"), py::arg("summary"), py::arg("function"),
               py::arg("original_only"), py::arg("revision"), py::arg("parameters"));
    module.def("own_stages", [] {
        std::vector<std::string> names;
        for (const auto& [name, stage] : own_stages()) {
            names.push_back(name);
        }
        return names;
    });
}

void enrol_own_stages(Enrolment& enrol) {
    for (const auto& [name, stage] : own_stages()) {
        enrol.add_stage(StageKind::spherizer, stage.info,
                        [function = stage.function.ptr()](const Parameters& parameters, const StageMaker&) {
                            return std::make_unique<PythonSpherizer>(function, parameters);
                        });
    }
}

} // namespace foam::python

FOAM_PLUGIN("python", "1.0", "Apache-2.0") {
    foam::python::enrol_own_stages(enrol);
}

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
