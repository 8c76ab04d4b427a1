// The whole pipeline on a file, as `foam spherize` runs it.
#pragma once

#include <foam/base/error.hpp>
#include <foam/runtime/run.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace foam {

/// Returns the file of one model of each shared robot, below the folder of robots.
inline const std::vector<std::string>& one_model_of_each_robot() {
    static const std::vector<std::string> files{
        "panda/moveit_resources_panda_description/urdf/panda.urdf",
        "fetch/fetch_description/robots/fetch.urdf",
        "baxter/example-robot-data/robots/baxter_description/urdf/baxter.urdf",
        "iiwa/model.urdf",
        "jaco/kinova_description/urdf/j2s7s300.urdf",
        "stretch/RE1V0/stretch_description_RE1V0_tool_stretch_gripper.urdf",
        "ur5/example-robot-data/robots/ur_description/urdf/ur5_robot.urdf",
    };
    return files;
}

/// Runs a recipe of which the version, the name and the outputs corpus.urdf and corpus.json are given.
inline RunResult run_text(const std::string& rest, Registry& registry, const std::filesystem::path& out) {
    const std::string text = "foam: 1\nname: corpus\n" + rest +
                             "outputs: [write.urdf: {file: corpus.urdf}, write.json: {file: corpus.json}]\n";
    const RecipeResult recipe = parse_recipe(text, {}, registry);
    if (!recipe.ok()) {
        throw Error(ErrorCode::recipe, recipe.diagnostics.at(0).text());
    }
    RunOptions options;
    options.out = out;
    options.fresh = true;
    return run(recipe.recipes.at(0), registry, options);
}

/// Runs repair, simplification, smoothing and spherize.medial with `spheres` over the whole model.
inline RunResult spherized(Registry& registry, const std::filesystem::path& file, std::size_t spheres,
                           const std::filesystem::path& out) {
    const bool robot = file.extension() == ".urdf";
    const std::string input = "'" + file.string() + "'";
    return run_text((robot ? "robot: {urdf: " + input + "}\n" : "mesh: " + input + "\n") +
                        "stages: [repair.auto, simplify.quadric, smooth.humphrey, spherize.medial, refine.row, refine.split]\n"
                        "budget: {spheres: " +
                        std::to_string(spheres) + "}\n",
                    registry, out);
}

} // namespace foam
