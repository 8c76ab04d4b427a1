// manifest.json: what was run on what, and what came out.
#pragma once

#include "input.hpp"
#include "output.hpp"

#include <string>
#include <vector>

namespace foam {

std::string manifest_json(const Workspace& workspace, const Input& input, const std::vector<InputFile>& meshes,
                          const std::vector<OutputFile>& outputs, const RunResult& result);

} // namespace foam
