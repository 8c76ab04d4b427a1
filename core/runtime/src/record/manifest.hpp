// manifest.json: the recipe, the inputs, and the results. All of it except `execution` is the same for the same recipe,
// inputs and versions, on every machine and in every run. `execution` has what may differ: places of files, times,
// cache hits, findings.
#pragma once

#include <foam/runtime/internal/input.hpp>
#include <foam/runtime/internal/output.hpp>

#include <string>
#include <vector>

namespace foam::inline runtime {

struct RunFiles {
    const Input& input;
    std::vector<InputFile> meshes;
    std::vector<OutputFile> outputs, debug_meshes;
};

std::string manifest_json(const Workspace& workspace, const RunFiles& files, const RunResult& result);

} // namespace foam::runtime
