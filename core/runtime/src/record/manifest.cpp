#include "record/record.hpp"

#include <foam/base/internal/files.hpp>
#include <foam/geometry/measure.hpp>
#include <foam/runtime/version.hpp>

#include <nlohmann/json.hpp>

#include <map>
#include <set>

namespace foam::inline runtime {
namespace {

using Json = nlohmann::ordered_json;

const char* text(Severity severity) {
    return severity == Severity::error     ? "error"
           : severity == Severity::warning ? "warning"
           : severity == Severity::info    ? "info"
                                           : "debug";
}

Json to_json(const Measures& measures) {
    return json_of_measures<Json>(measures);
}

Json to_json(const PlaneReach& reach) {
    const ClipPlane& plane = reach.plane;
    return {{"normal", {plane.normal.x, plane.normal.y, plane.normal.z}},
            {"offset_m", plane.offset},
            {"reach_m", plane.reach},
            {"reached_m", reach.reached},
            {"kept", reach.kept()}};
}

Json to_json(const LinkReport& report) {
    Json stages = Json::array();
    for (const StageReport& stage : report.stages) {
        stages.push_back({{"stage", stage.stage}, {"input", stage.input}, {"output", stage.output}});
    }
    Json link{{"link", report.link}, {"stages", stages}};
    if (report.skipped) {
        link["skipped"] = true;
    } else if (!report.error.empty()) {
        link["error"] = report.error;
    } else {
        link["growth_m"] = report.growth;
        link["measures"] = to_json(report.measures);
        if (!spheres_alone(report.kinds)) {
            link["kinds"] = json_of_kinds<Json>(report.kinds);
        }
        if (report.visual_gap) {
            const VisualGap& gap = *report.visual_gap;
            gap.unknown.empty() ? link["visual_gap_m"] = gap.length : link["visual_gap_unknown"] = gap.unknown;
        }
        if (report.filled > 0) {
            link["filled_volume_m3"] = report.filled;
        }
        if (report.unpadded) {
            link["pad_m"] = report.pad;
            link["excess_unpadded"] = report.unpadded->excess;
        }
        for (const PlaneReach& plane : report.clip) {
            link["clip"].push_back(to_json(plane));
        }
    }
    return link;
}

Json to_json(const InputFile& mesh) {
    return {{"file", mesh.reference}, {"digest", mesh.digest}, {"bytes", mesh.bytes}};
}

Json to_json(const WrittenProof& proof) {
    Json json{{"link", proof.link},
              {"spheres", proof.spheres},
              {"triangles", proof.triangles},
              {"pieces", proof.pieces},
              {"halvings", proof.halvings}};
    if (proof.float32) {
        json["float32"] = true;
    }
    return json;
}

Json to_json(const RunPhase& phase) {
    return {{"phase", phase.phase}, {"wall_seconds", phase.seconds}, {"cpu_seconds", phase.cpu_seconds}};
}

template <class T> Json to_json(const std::vector<T>& list);

Json to_json(const OutputFile& output) {
    Json json{{"file", output.file}, {"digest", output.digest}, {"bytes", output.bytes}};
    if (!output.portable_digest.empty()) {
        json["portable_digest"] = output.portable_digest;
    }
    if (!output.stage.empty()) {
        json["stage"] = output.stage;
        json["proofs"] = to_json(output.proofs);
    }
    return json;
}

template <class T> Json to_json(const std::vector<T>& list) {
    Json json = Json::array();
    for (const T& entry : list) {
        json.push_back(to_json(entry));
    }
    return json;
}

/// Returns the digest of a plugin's file, which distinguishes builds of one version; null if the file no longer exists.
Json build_of(const std::string& plugin, const Registry& registry) {
    for (const PluginRecord& record : registry.plugins()) {
        if (record.loaded() && record.name == plugin) {
            try {
                return digest_of(read_file(record.file));
            } catch (const Error&) {
                return nullptr;
            }
        }
    }
    return nullptr;
}

/// Returns the plugins whose stages made the outputs.
Json plugins_used(const Workspace& workspace, const RunFiles& files, const RunResult& result) {
    std::set<std::string> stages{workspace.recipe.spherizer.stage, files.input.report.stage};
    for (const OutputCall& output : workspace.recipe.outputs) {
        stages.insert(output.writer.stage);
    }
    for (const LinkReport& link : result.links) {
        for (const StageReport& stage : link.stages) {
            stages.insert(stage.stage);
        }
    }
    std::map<std::string, const RegisteredStage*> used;
    for (const std::string& stage : stages) {
        if (const RegisteredStage* found = workspace.registry.find(stage)) {
            used.emplace(found->plugin, found);
            for (const std::string& other : found->info.uses) {
                if (const RegisteredStage* inner = workspace.registry.find(other)) {
                    used.emplace(inner->plugin, inner);
                }
            }
        }
    }
    Json list = Json::array();
    for (const auto& [name, stage] : used) {
        list.push_back({{"plugin", name},
                        {"version", stage->plugin_version},
                        {"license", stage->license},
                        {"build", build_of(name, workspace.registry)}});
    }
    return list;
}

Json to_json(const OneSidedDistance& distance) {
    return {{"max_m", distance.max}, {"mean_m", distance.mean}};
}

Json to_json(const MeshChange& change) {
    const auto or_null = [](const std::optional<double>& volume) { return volume ? Json(*volume) : Json(nullptr); };
    return {{"triangles_before", change.triangles_before},        {"triangles_after", change.triangles_after},
            {"input_to_output", to_json(change.input_to_output)}, {"output_to_input", to_json(change.output_to_input)},
            {"volume_before_m3", or_null(change.volume_before)},  {"volume_after_m3", or_null(change.volume_after)},
            {"defects_before", describe(change.before)},          {"defects_after", describe(change.after)}};
}

Json timings_of(const LinkReport& link) {
    Json stages = Json::array();
    for (const StageReport& stage : link.stages) {
        Json metrics = Json::object();
        for (const auto& metric : stage.metrics) {
            metrics[metric.name] = {{"value", metric.value}, {"unit", metric.unit}};
        }
        Json entry{{"stage", stage.stage},
                   {"input", stage.input},
                   {"wall_seconds", stage.seconds},
                   {"cached", stage.cached},
                   {"metrics", metrics}};
        if (stage.change) {
            entry["change"] = to_json(*stage.change);
        }
        stages.push_back(std::move(entry));
    }
    return {{"link", link.link}, {"stages", stages}};
}

/// Returns the recipe's file and the files that it extends, and the selected parts of it.
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

Json execution_of(const Workspace& workspace, const RunFiles& files, const RunResult& result) {
    const Recipe& recipe = workspace.recipe;
    Json execution{{"recipe", recipe_files(recipe)},
                   {"input",
                    {{"taken", files.input.chosen},
                     {"candidates", recipe.urdf.empty() ? recipe.mesh : recipe.urdf},
                     {"file", files.input.file.string()}}},
                   {"mesh_files", Json::array()},
                   {"threads", thread_count()},
                   {"wall_seconds", result.seconds},
                   {"cpu_seconds", result.cpu_seconds},
                   {"phases", to_json(result.phases)},
                   {"links", Json::array()},
                   {"findings", Json::array()}};
    for (const InputFile& mesh : files.meshes) {
        execution["mesh_files"].push_back(mesh.file.string());
    }
    for (const LinkReport& link : result.links) {
        execution["links"].push_back(timings_of(link));
    }
    for (const Finding& finding : result.findings) {
        execution["findings"].push_back({{"severity", text(finding.severity)},
                                         {"link", finding.link},
                                         {"stage", finding.stage},
                                         {"message", finding.message}});
    }
    return execution;
}

} // namespace

std::string manifest_json(const Workspace& workspace, const RunFiles& files, const RunResult& result) {
    const StageReport& loading = files.input.report;
    Json manifest{{"foam_manifest", 1},
                  {"foam_version", version()},
                  {"foam_build", build_of_libraries()},
                  {"libraries", library_versions()},
                  {"plugins", plugins_used(workspace, files, result)},
                  {"settings", settings_of(workspace.recipe, workspace.registry)},
                  {"input",
                   {{"file", loading.input},
                    {"digest", files.input.digest},
                    {"bytes", files.input.bytes},
                    {"stage", loading.stage},
                    {"output", loading.output}}},
                  {"mesh_files", to_json(files.meshes)},
                  {"links", to_json(result.links)},
                  {"certified", result.certified},
                  {"proof", json_of_proof<Json>(result.proved)},
                  {"total", to_json(result.total)},
                  {"outputs", to_json(files.outputs)},
                  {"debug_meshes", to_json(files.debug_meshes)},
                  {"execution", execution_of(workspace, files, result)}};
    if (!files.input.further.empty()) {
        manifest["further_files"] = to_json(files.input.further);
    }
    if (result.total_unpadded) {
        manifest["total"]["excess_unpadded"] = result.total_unpadded->excess;
    }
    if (result.cut != Cut::none) {
        manifest["cut"] = to_string(result.cut);
    }
    return manifest.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

} // namespace foam::runtime
