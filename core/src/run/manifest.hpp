// manifest.json: what was run on what, and what came out. All of it but `execution` is the same for the same recipe,
// inputs and versions, wherever and however often it is run; `execution` holds what may differ: where files lay, how
// long it took, what the cache held, what was said meanwhile.
#pragma once

#include "input.hpp"
#include "output.hpp"

#include <string>
#include <vector>

namespace foam {

struct RunFiles {
    const Input& input;
    std::vector<InputFile> meshes;
    std::vector<OutputFile> outputs, debug_meshes;
};

std::string manifest_json(const Workspace& workspace, const RunFiles& files, const RunResult& result);

} // namespace foam
