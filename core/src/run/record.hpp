// A manifest read back.
#pragma once

#include "digest.hpp"

#include <foam/host/verify.hpp>

#include <nlohmann/json.hpp>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace foam {

/// A digest that a manifest holds, and of what.
struct Checkpoint {
    std::string link, stage, input;
    Digest digest;
};

struct PluginVersion {
    std::string name, version;
    Digest build; ///< of its file; empty if the manifest does not know it
};

struct RecordedFile {
    std::string file; ///< relative to the run directory
    Digest digest;
    std::size_t bytes = 0;
};

/// Where a run found an input.
struct InputPlace {
    std::string reference; ///< as written: "package://arm/meshes/hand.stl"
    std::filesystem::path file;
};

struct Record {
    std::string source; ///< the manifest's path, for messages
    std::string foam_version;
    std::string cut; ///< what ended the search for better spheres before its time; empty: nothing
    std::map<std::string, std::string> libraries;
    std::vector<PluginVersion> plugins;
    nlohmann::ordered_json settings;
    std::vector<Checkpoint> inputs; ///< robot or mesh file, then the mesh files of the links
    std::vector<InputPlace> places; ///< of the inputs, as far as the manifest still says it
    std::vector<Checkpoint> stages; ///< what each stage made: the robot, then link by link
    std::vector<Checkpoint> outputs, debug_meshes;
    std::vector<RecordedFile> files; ///< outputs and debug meshes as they lie in the run directory
};

/// Throws Error(usage) saying what is wrong with the text.
Record parse_record(const std::string& text, const std::string& source);
/// Throws Error(usage) if there is no manifest.
Record read_record(const std::filesystem::path& manifest);

/// Throws Error(usage) for the record of a run that was cut short: it cannot be expected to come out the same again.
void require_whole(const Record& record);

/// What differs between two lists of checkpoints, in the order of `expected`; what `found` has besides at the end.
std::vector<Difference> compare(const std::vector<Checkpoint>& expected, const std::vector<Checkpoint>& found);
/// Settings by their path in the recipe: "budget.spheres", "stages[1].simplify.quadric.ratio".
std::vector<Difference> compare_settings(const nlohmann::ordered_json& expected, const nlohmann::ordered_json& found);
/// foam, libraries and plugins that are not the manifest's, a sentence each; builds of one version apart, too.
std::vector<std::string> other_versions(const Record& expected, const Record& found);

} // namespace foam
