#include "input/inputs_here.hpp"

#include <foam/runtime/internal/input.hpp>
#include <foam/runtime/internal/prepare.hpp>

namespace foam::inline runtime {

InputsHere inputs_here(const Recipe& recipe, const Registry& registry) {
    Journal journal(nullptr);
    const Cache cache{std::filesystem::path()};
    const RunOptions options;
    const Workspace workspace{recipe, registry, options, journal, cache};
    const Input input = load_input(workspace);
    InputsHere here;
    here.digests.push_back({"", "input file", input.report.input, input.digest});
    here.files[input.report.input] = input.file;
    for (const InputFile& mesh : mesh_files(workspace, *input.robot)) {
        here.digests.push_back({"", "mesh file", mesh.reference, mesh.digest});
        here.files[mesh.reference] = mesh.file;
    }
    return here;
}

} // namespace foam::runtime
