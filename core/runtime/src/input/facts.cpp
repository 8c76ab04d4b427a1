// What outputs ask of the robot, before there is anything to write.
#include "input/inputs.hpp"

#include <foam/sdk/writing.hpp>

namespace foam::inline runtime {

FactsForOutputs facts_for_outputs(const Workspace& workspace, const Robot& robot) {
    FactsForOutputs result{workspace.recipe.facts, {}};
    if (workspace.options.out.empty()) { // nothing is written
        return result;
    }
    for (const OutputCall& output : workspace.recipe.outputs) {
        const StageInfo& writer = workspace.registry.find(output.writer.stage)->info;
        std::string sentence = give_tool_frame(result.facts, robot, writer, !output.into.empty());
        if (!sentence.empty()) {
            result.said.push_back(std::move(sentence));
        }
    }
    return result;
}

} // namespace foam::inline runtime
