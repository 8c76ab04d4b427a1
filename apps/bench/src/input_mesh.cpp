#include "input_mesh.hpp"

#include <foam/base/error.hpp>
#include <foam/recipe/recipe.hpp>
#include <foam/runtime/run.hpp>
#include <foam/sdk/stage.hpp>

#include <fmt/format.h>

#include <cstdlib>
#include <limits>

namespace foam::inline bench::experiment {

namespace {

std::string shared_folder() {
    const char* shared = std::getenv("FOAM_SHARED");
    return shared ? shared : "";
}

/// Adds to each relative path the one in the folder FOAM_SHARED.
std::vector<std::string> with_shared(const std::vector<std::string>& references) {
    std::vector<std::string> result;
    for (const std::string& reference : references) {
        result.push_back(reference);
        if (!shared_folder().empty() && reference.find("://") == std::string::npos) {
            result.push_back((std::filesystem::path(shared_folder()) / reference).string());
        }
    }
    return result;
}

} // namespace

Mesh input_mesh(const Bench& bench, const Experiment& experiment, const MeshCandidates& candidates,
                std::string& chosen) {
    Recipe input;
    input.file = experiment.file;
    input.mesh = with_shared(candidates.references);
    input.input_where = candidates.where;
    const std::filesystem::path path = resolve_input(input, &chosen).path;
    if (const std::string shared = shared_folder(); !shared.empty() && chosen.starts_with(shared)) {
        chosen = std::filesystem::path(chosen).lexically_relative(shared).string();
    }
    const std::string extension = path.extension().string();
    const RegisteredStage* loader =
        bench.registry().find_for_extension(StageKind::mesh_loader, extension.substr(extension.empty() ? 0 : 1));
    if (!loader) {
        throw Error(ErrorCode::input,
                    fmt::format("{}: no loader reads files that end in '{}'", path.string(), extension));
    }
    if (loader->info.isolation.process.value_or(false)) {
        throw Error(ErrorCode::input,
                    fmt::format("{}: {} reads it in a process of its own, experiments read meshes in this one; "
                                "remedy: convert it to STL, OBJ, PLY, DAE, OFF or GLB",
                                path.string(), loader->info.name));
    }
    LimitedContext context(bench, std::numeric_limits<double>::infinity());
    return bench.registry().make<MeshLoader>(loader->info.name)->load(path, context);
}

} // namespace foam::bench::experiment
