#include "session_work.hpp"

#include <foam/base/error.hpp>
#include <foam/base/internal/files.hpp>
#include <foam/base/text.hpp>
#include <foam/judge/written_model.hpp>
#include <foam/recipe/quick_recipe.hpp>
#include <foam/runtime/version.hpp>
#include <foam/sdk/context.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace foam::inline view {
namespace {

namespace fs = std::filesystem;

SphereFile file_of(const ViewedRobot& robot, const ModelState& state) {
    SphereFile file;
    file.file = robot.file.empty() ? fs::path(robot.robot->name) : robot.file;
    for (std::size_t l = 0; l < state.size(); ++l) {
        if (!state[l]->spheres.empty()) {
            file.links.push_back({robot.robot->links[l].name, state[l]->spheres});
        }
    }
    return file;
}

SphereModel model_of(const ViewedRobot& robot, const Original* original, const RegisteredStage& writer,
                     const SphereFile& file, const std::atomic<bool>& cancel) {
    SphereModel model = sphere_model_of(file, robot.robot);
    if (original) {
        for (const OriginalLink& link : original->links) {
            model.geometry[link.link] = link.solid;
        }
    }
    model.provenance = fmt::format("foam {}, edited in foam view", version());
    if (writer.info.consumer.rest_pose && robot.kinematics) {
        give_rest_pose(model);
    }
    if (lists_pairs(writer.info, {}, false) && model.groups.size() > 1 && robot.kinematics) {
        model.ignored_pairs = judge::ignored_pairs_of(model, &cancel);
    }
    return model;
}

std::vector<std::string> uncovered(const ViewedRobot& robot, const Original& original, const ModelState& state) {
    std::vector<std::string> links;
    for (const OriginalLink& link : original.links) {
        const std::size_t l = link_index(*robot.robot, link.link);
        if (!state[l]->spheres.empty() && !certify(*link.solid, state[l]->spheres).holds) {
            links.push_back(shown(link.link));
        }
    }
    return links;
}

} // namespace

std::vector<SaveFormat> save_formats(const Registry& registry) {
    std::vector<SaveFormat> formats{{"recipe", "yaml", "foam run"}};
    for (const auto& [name, stage] : registry.stages()) {
        if (stage.kind == StageKind::writer) {
            const std::string format = name.substr(name.find('.') + 1);
            formats.push_back({format, stage.info.extensions.empty() ? format : stage.info.extensions.front(),
                               stage.info.consumer.name});
        }
    }
    return formats;
}

fs::path target_of(const fs::path& folder, const std::string& name) {
    const fs::path file(name);
    if (name.empty() || name.size() > 200 || file.filename() != file || name.starts_with(".") ||
        name.find('\\') != name.npos || shown(name) != name) {
        throw Error(ErrorCode::usage, fmt::format("'{}' is not a file name; remedy: a name without folders, such as "
                                                  "robot_spheres.urdf",
                                                  shown(name)));
    }
    return folder / file;
}

void require_free(const Registry& registry, const std::string& format, const fs::path& target,
                  const std::vector<fs::path>& inputs, bool replace) {
    const std::vector<fs::path> files =
        format == "recipe" ? std::vector{target} : files_of(writer_for(format, registry).info, target);
    for (const fs::path& file : files) {
        const std::string name = shown(file.filename().string());
        std::error_code error; // what does not exist is replaced by nothing
        if (std::any_of(inputs.begin(), inputs.end(),
                        [&](const fs::path& i) { return fs::equivalent(file, i, error); })) {
            throw Error(ErrorCode::usage, fmt::format("{} is what this page shows; remedy: another name", name));
        }
        if (fs::is_directory(file, error) || (!replace && fs::exists(fs::symlink_status(file, error)))) {
            throw Error(ErrorCode::usage, fmt::format("{} exists already; remedy: another name, or 'replace'", name));
        }
    }
}

Saved save_model(const ViewedRobot& robot, const Original* original, const Registry& registry, const ModelState& state,
                 const std::string& format, const fs::path& target, const std::atomic<bool>& cancel) {
    const RegisteredStage& stage = writer_for(format, registry);
    const auto writer = registry.make<Writer>(stage.info.name);
    const SphereFile file = file_of(robot, state);
    Saved saved;
    const SphereModel model = model_of(robot, original, stage, file, cancel);
    QuietContext context;
    const auto [files, statement] = judged_files(*writer, stage.info, model, original, file, target, context);
    saved.statement = statement;
    for (const WrittenFile& written : files) {
        write_file(written.file, written.bytes);
        saved.files.push_back(written.file);
    }
    return saved;
}

Saved save_recipe(const ViewedRobot& robot, const Original* original, const SubjectOptions& options, Registry& registry,
                  const ModelState& state, const fs::path& target) {
    if (!original) {
        throw Error(ErrorCode::usage, "a recipe needs the robot's original geometry; remedy: foam view ROBOT MODEL");
    }
    if (const std::vector<std::string> links = uncovered(robot, *original, state); !links.empty()) {
        throw Error(ErrorCode::usage,
                    fmt::format("the spheres of {} do not cover {}: a recipe would add others; remedy: 'close gaps' or "
                                "'again' first",
                                fmt::join(links, ", "), links.size() == 1 ? "it" : "them"));
    }
    const std::string text = to_yaml(recipe_of(robot, options, registry, state, {}, true), registry, true);
    write_file(target, text);
    return {{target}, "foam run gives these spheres again"};
}

} // namespace foam::inline view
