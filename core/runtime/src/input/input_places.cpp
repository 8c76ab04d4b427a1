#include "input/inputs.hpp"

#include <foam/runtime/internal/input.hpp>

#include <fmt/format.h>

#include <set>

namespace foam::inline runtime {
namespace fs = std::filesystem;
namespace {

/// Returns the folder of the package in `package://PKG/rest`, resolved to `file`; empty for other references.
fs::path package_folder(const InputPlace& place) {
    const std::string& reference = place.reference;
    if (!reference.starts_with("package://") && !reference.starts_with("model://")) {
        return {};
    }
    const std::string location = reference.substr(reference.find("://") + 3), file = place.file.string();
    const std::string package = location.substr(0, location.find('/')), rest = location.substr(package.size());
    if (!file.ends_with(rest)) {
        return {}; // ".." or escapes in it
    }
    const fs::path folder = file.substr(0, file.size() - rest.size());
    return folder.filename() == package ? folder.parent_path() : folder;
}

std::string remedy(const fs::path& folder) {
    std::error_code error;
    if (folder.empty()) {
        return "";
    }
    return fs::is_directory(folder, error)
               ? fmt::format("; remedy: FOAM_PACKAGE_PATH={}", folder.string())
               : "; remedy: set FOAM_PACKAGE_PATH to the folder that holds the package here";
}

} // namespace

std::vector<std::string> inputs_elsewhere(const Record& record, const std::optional<InputsHere>& here) {
    std::vector<std::string> list;
    std::set<fs::path> named;
    for (const InputPlace& place : record.places) {
        const bool input = &place == &record.places.front();
        if (here) {
            const auto found = here->files.find(input ? record.inputs.front().input : place.reference);
            if (found != here->files.end() && found->second == place.file) {
                continue;
            }
        }
        const fs::path folder = package_folder(place);
        if (input || (!folder.empty() && !named.contains(folder))) {
            list.push_back(fmt::format("{}: the run found '{}' at {}{}", input ? "input" : "mesh file", place.reference,
                                       place.file.string(), named.contains(folder) ? "" : remedy(folder)));
            named.insert(folder);
        }
    }
    return list;
}

InputsHere inputs_here(const Recipe& recipe, const Registry& registry) {
    Journal journal(nullptr);
    const Cache cache{std::filesystem::path()};
    const RunOptions options;
    const Workspace workspace{recipe, registry, options, journal, cache};
    const Input input = load_input(workspace);
    InputsHere here;
    here.digests.push_back({"", "input file", input.report.input, input.digest});
    here.files[input.report.input] = input.file;
    for (const InputFile& further : input.further) {
        here.digests.push_back({"", "further file", further.reference, further.digest});
    }
    for (const InputFile& mesh : mesh_files(workspace, *input.robot)) {
        here.digests.push_back({"", "mesh file", mesh.reference, mesh.digest});
        here.files[mesh.reference] = mesh.file;
    }
    return here;
}

} // namespace foam::inline runtime
