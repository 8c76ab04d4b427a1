// Figures, proofs and pairs of links, as JSON text.
#include "robot.hpp"
#include "work.hpp"

#include <foam/base/error.hpp>
#include <foam/judge/judge_json.hpp>
#include <foam/recipe/json.hpp>
#include <foam/runtime/plan.hpp>

#include <nlohmann/json.hpp>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <fmt/format.h>

#include <algorithm>

namespace foam::python {
namespace {

using Json = nlohmann::ordered_json;

std::string evaluated(const HeldRobot& robot, const SphereFile& spheres, const Renames& renames, std::uint64_t seed) {
    return worked([&](const Signals&) {
        const MatchedModel model = match(robot.original, spheres, renames);
        Json json{{"original", robot.original.file.string()}, {"seed", seed}};
        json.update(json_of_evaluation<Json>(robot.original, model, evaluate(robot.original, model, seed)));
        return json_text(json);
    });
}

std::string certified(const HeldRobot& robot, const SphereFile& spheres, const Renames& renames, bool outer) {
    return worked([&](const Signals&) {
        const Guarantee guarantee = outer ? Guarantee::outer : Guarantee::inner;
        const MatchedModel model = match(robot.original, spheres, renames);
        const std::vector<LinkProof> proofs = prove(robot.original, model, guarantee);
        const auto holds = [](const LinkProof& proof) { return proof.holds; };
        return json_text(Json{{"original", robot.original.file.string()},
                              {"model", model.file.file.string()},
                              {"model_format", model.file.format},
                              {"guarantee", outer ? "outer" : "inner"},
                              {"certified", std::all_of(proofs.begin(), proofs.end(), holds)},
                              {"proof", json_of_proof<Json>(proved_links(robot.original, model, proofs, guarantee))},
                              {"notes", model.notes},
                              {"links", json_of_proofs<Json>(robot.original, proofs, outer)}});
    });
}

/// The matrix as JSON, as SRDF and as YAML of cuRobo.
py::tuple paired(const HeldRobot& robot, const SphereFile* spheres, std::size_t per_link, const std::string& words,
                 const JointValues& reference, std::size_t samples, double confidence, std::uint64_t seed,
                 std::size_t proof_boxes) {
    Json json;
    std::string srdf, curobo;
    work_aside(
        [&](const std::atomic<bool>& cancel) {
            const Original& original = robot.original;
            const CollisionModel model = spheres ? collision_model_of(original, match(original, *spheres))
                                                 : collision_model_of(original.loaded, *robot.registry, per_link);
            const Kinematics kinematics(model.robot);
            const SelfCollisionMatrix matrix = self_collision_matrix(kinematics, model,
                                                                     {.samples = samples,
                                                                      .confidence = confidence,
                                                                      .seed = seed,
                                                                      .proof_boxes = proof_boxes,
                                                                      .reference = reference,
                                                                      .cancel = &cancel});
            json = json_of_matrix<Json>(original.file.string(), words, seed, kinematics, model, matrix);
            srdf = srdf_text(*model.robot, matrix);
            curobo = curobo_text(*model.robot, matrix);
        },
        [] {});
    return py::make_tuple(json_text(json), srdf, curobo);
}

std::string checked(Registry& registry, const std::optional<std::filesystem::path>& file, const std::string& text,
                    const std::vector<Setting>& settings, const std::vector<std::string>& variants) {
    return worked([&](const Signals&) {
        RecipeResult read = file ? read_recipe(*file, registry, settings, variants)
                                 : parse_recipe(text, "recipe.yaml", registry, settings, variants);
        add_unknown_names(read, registry);
        return json_text(json_of_findings<Json>(read));
    });
}

std::string stages_of(const Registry& registry) {
    Json json = Json::array();
    for (const auto& [name, stage] : registry.stages()) {
        json.push_back(json_of_stage<Json>(stage));
    }
    return json_text(json);
}

std::string plugins_of(const Registry& registry) {
    Json json = Json::array();
    for (const PluginRecord& record : registry.plugins()) {
        json.push_back(json_of_plugin<Json>(record));
    }
    return json_text(json);
}

} // namespace

void add_judge(py::module_& module) {
    module.def("evaluate", &evaluated, py::arg("robot"), py::arg("spheres"), py::arg("rename"), py::arg("seed"));
    module.def("certify", &certified, py::arg("robot"), py::arg("spheres"), py::arg("rename"), py::arg("outer"));
    module.def("self_collision", &paired, py::arg("robot"), py::arg("spheres").none(true), py::arg("per_link"),
               py::arg("words"), py::arg("reference"), py::arg("samples"), py::arg("confidence"), py::arg("seed"),
               py::arg("proof_boxes"));
    module.def("check", &checked, py::arg("registry"), py::arg("file"), py::arg("text"), py::arg("settings"),
               py::arg("variants"));
    module.def("stages", &stages_of, py::arg("registry"));
    module.def("plugins", &plugins_of, py::arg("registry"));
    module.def("plugin_folders", [] { return plugin_directories(); });
}

} // namespace foam::python
