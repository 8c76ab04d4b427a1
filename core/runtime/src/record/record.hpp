// The record of a run: its inputs, settings, and manifest.
#pragma once

#include <foam/recipe/recipe.hpp>
#include <foam/runtime/internal/cache.hpp>
#include <foam/runtime/internal/input.hpp>
#include <foam/runtime/internal/output.hpp>
#include <foam/runtime/verify.hpp>

#include <nlohmann/json.hpp>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace foam::inline runtime {

/// Returns name, seed, stages with all parameters that affect their output, budget, guarantee, overrides, outputs. Not
/// the places of inputs (their digests are compared), nor pictures and files for people.
nlohmann::ordered_json settings_of(const Recipe& recipe, const Registry& registry);

/// A digest in a manifest, and what it is the digest of.
struct Checkpoint {
    std::string link, stage, input;
    Digest digest;
};

struct PluginVersion {
    std::string name, version;
    Digest build; ///< of its file; empty if the manifest does not have it
};

struct RecordedFile {
    std::string file; ///< relative to the run directory
    Digest digest;
    std::size_t bytes = 0;
};

/// The place where a run found an input.
struct InputPlace {
    std::string reference; ///< as written: "package://arm/meshes/hand.stl"
    std::filesystem::path file;
};

struct Record {
    std::string source; ///< the manifest's path, for messages
    std::string foam_version;
    std::string cut; ///< why the search for better spheres ended early; empty: it did not
    std::map<std::string, std::string> libraries;
    std::vector<PluginVersion> plugins;
    nlohmann::ordered_json settings;
    std::vector<Checkpoint> inputs; ///< robot or mesh file, then the mesh files of the links
    std::vector<InputPlace> places; ///< of the inputs, as far as the manifest has them
    std::vector<Checkpoint> stages; ///< the result of each stage: the robot, then link by link
    std::vector<Checkpoint> outputs, debug_meshes;
    std::vector<RecordedFile> files; ///< outputs and debug meshes of the run directory
};

/// Parses a manifest. Throws Error(usage) with the error in the text.
Record parse_record(const std::string& text, const std::string& source);
/// Reads a manifest. Throws Error(usage) if there is none.
Record read_record(const std::filesystem::path& manifest);

/// Throws Error(usage) if the run was ended early: its result cannot be expected to be reproducible.
void require_whole(const Record& record);

/// Returns the differences between two lists of checkpoints, in the order of `expected`; additional ones of `found` at
/// the end.
std::vector<Difference> compare(const std::vector<Checkpoint>& expected, const std::vector<Checkpoint>& found);
/// Returns the differences of settings by their path in the recipe: "budget.spheres",
/// "stages[1].simplify.quadric.ratio".
std::vector<Difference> compare_settings(const nlohmann::ordered_json& expected, const nlohmann::ordered_json& found);
/// Returns a sentence for each version of foam, libraries and plugins that differs from the manifest's, also for
/// different builds of one version.
std::vector<std::string> other_versions(const Record& expected, const Record& found);

// manifest.json: the recipe, the inputs, and the results. All of it except `execution` is the same for the same recipe,
// inputs and versions, on every machine and in every run. `execution` has what may differ: places of files, times,
// cache hits, findings.

struct RunFiles {
    const Input& input;
    std::vector<InputFile> meshes;
    std::vector<OutputFile> outputs, debug_meshes;
};

std::string manifest_json(const Workspace& workspace, const RunFiles& files, const RunResult& result);

} // namespace foam::inline runtime
