#include "manifest.hpp"

#include <nlohmann/json.hpp>

#include <set>

namespace foam {
namespace {

using Json = nlohmann::ordered_json;

const char* text(Severity severity) {
    return severity == Severity::error     ? "error"
           : severity == Severity::warning ? "warning"
           : severity == Severity::info    ? "info"
                                           : "debug";
}

Json to_json(const Measures& m) {
    return {{"spheres", m.spheres},
            {"certified", m.certified},
            {"gap_m", m.gap},
            {"covered", m.covered},
            {"excess", m.excess},
            {"excess_standard_error", m.excess_error},
            {"missing", m.missing},
            {"missing_standard_error", m.missing_error},
            {"protrusion_max_m", m.protrusion_max},
            {"protrusion_mean_m", m.protrusion_mean},
            {"volume_m3", m.volume},
            {"area_m2", m.area}};
}

Json to_json(const StageReport& report) {
    Json metrics = Json::object();
    for (const auto& metric : report.metrics) {
        metrics[metric.name] = {{"value", metric.value}, {"unit", metric.unit}};
    }
    return {{"stage", report.stage}, {"seconds", report.seconds}, {"cached", report.cached}, {"metrics", metrics}};
}

Json to_json(const LinkReport& report) {
    Json stages = Json::array();
    for (const StageReport& stage : report.stages) {
        stages.push_back(to_json(stage));
    }
    Json link{{"link", report.link}, {"stages", stages}};
    if (report.skipped) {
        link["skipped"] = true;
    } else if (!report.error.empty()) {
        link["error"] = report.error;
    } else {
        link["growth_m"] = report.growth;
        link["measures"] = to_json(report.measures);
    }
    return link;
}

/// The plugins whose stages the recipe or its loaders use.
Json plugins_used(const Workspace& workspace, const RunResult& result) {
    std::set<std::string> stages{workspace.recipe.spherizer.stage, "load.urdf"};
    for (const OutputCall& output : workspace.recipe.outputs) {
        stages.insert(output.writer.stage);
    }
    for (const LinkReport& link : result.links) {
        for (const StageReport& stage : link.stages) {
            stages.insert(stage.stage);
        }
    }
    Json used = Json::array();
    std::set<std::string> names;
    for (const std::string& stage : stages) {
        const RegisteredStage* found = workspace.registry.find(stage);
        if (found && names.insert(found->plugin).second) {
            used.push_back(
                {{"plugin", found->plugin}, {"version", found->plugin_version}, {"license", found->license}});
        }
    }
    return used;
}

/// The recipe's file and those that it extends, and what was chosen of it.
Json recipe_files(const Recipe& recipe) {
    Json files{{"file", recipe.file.string()}, {"digest", digest_of(recipe.source)}, {"extends", Json::array()}};
    for (const RecipeFile& base : recipe.extended) {
        files["extends"].push_back({{"file", base.file.string()}, {"digest", digest_of(base.text)}});
    }
    if (!recipe.variant.empty()) {
        files["variant"] = recipe.variant;
    }
    return files;
}

} // namespace

std::string manifest_json(const Workspace& workspace, const Input& input, const std::vector<InputFile>& meshes,
                          const std::vector<OutputFile>& outputs, const RunResult& result) {
    Json manifest;
    manifest["foam_manifest"] = 1;
    manifest["foam_version"] = FOAM_VERSION;
    manifest["name"] = workspace.recipe.name;
    manifest["seed"] = workspace.recipe.seed;
    manifest["recipe"] = recipe_files(workspace.recipe);
    manifest["input"] = {{"taken", input.chosen},
                         {"candidates", workspace.recipe.urdf.empty() ? workspace.recipe.mesh : workspace.recipe.urdf},
                         {"file", input.file.string()},
                         {"digest", input.digest}};
    manifest["mesh_files"] = Json::array();
    for (const InputFile& mesh : meshes) {
        manifest["mesh_files"].push_back(
            {{"file", mesh.file.string()}, {"digest", mesh.digest}, {"bytes", mesh.bytes}});
    }
    manifest["plugins"] = plugins_used(workspace, result);
    manifest["outputs"] = Json::array();
    for (const OutputFile& output : outputs) {
        manifest["outputs"].push_back({{"file", output.file}, {"digest", output.digest}, {"bytes", output.bytes}});
    }
    manifest["certified"] = result.certified;
    manifest["total"] = to_json(result.total);
    manifest["links"] = Json::array();
    for (const LinkReport& link : result.links) {
        manifest["links"].push_back(to_json(link));
    }
    manifest["findings"] = Json::array();
    for (const Finding& finding : result.findings) {
        manifest["findings"].push_back({{"severity", text(finding.severity)},
                                        {"link", finding.link},
                                        {"stage", finding.stage},
                                        {"message", finding.message}});
    }
    manifest["threads"] = thread_count();
    manifest["seconds"] = result.seconds;
    manifest["cpu_seconds"] = result.cpu_seconds;
    return manifest.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

} // namespace foam
