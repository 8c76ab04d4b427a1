// From spheres to the files of writers.
#include "robot.hpp"
#include "work.hpp"

#include <foam/base/error.hpp>
#include <foam/judge/written_model.hpp>
#include <foam/recipe/quick_recipe.hpp>
#include <foam/robot/held_joints.hpp>
#include <foam/runtime/version.hpp>
#include <foam/sdk/kinds.hpp>
#include <foam/sdk/writing.hpp>

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <fmt/format.h>

#include <algorithm>

namespace foam::python {
namespace {

using Given = std::map<std::string, ParameterValue>;

/// Keeps what a writer warns of.
class Warnings final : public QuietContext {
public:
    void log(Severity severity, std::string_view message) override {
        if (severity >= Severity::warning) {
            messages.emplace_back(message);
        }
    }
    std::vector<std::string> messages;
};

KindCounts kinds_of_model(const SphereModel& model) {
    KindCounts kinds{};
    for (const SphereGroup& group : model.groups) {
        kinds = sum_of(kinds, kinds_of(group.tree.elements()));
    }
    return kinds;
}

/// Makes the model of spheres from elsewhere as complete as `foam convert` does.
void complete(SphereModel& model, const SphereFile& spheres, const Original* original, const StageInfo& writer,
              const Given& parameters, bool into, const std::atomic<bool>& cancel) {
    model.provenance = fmt::format("foam {}; {}, {}; {}", version(), spheres.file.filename().string(), spheres.format,
                                   counts_text(kinds_of_model(model)));
    if (lists_pairs(writer, parameters, into) && original && model.groups.size() > 1) {
        model.ignored_pairs = ignored_pairs_of(model, &cancel);
    }
    if (writer.consumer.rest_pose) {
        give_rest_pose(model);
    }
}

/// Takes the one tip of the robot as tool frame where the writer needs one. Throws Error(usage) for a joint that cannot
/// be held, and where there are several tips.
void complete_facts(RobotFacts& facts, const Robot& robot, const StageInfo& writer, bool into) {
    for (const auto& [joint, position] : has_only_names(robot) ? JointValues{} : facts.lock_joints) {
        if (const std::string why = why_not_held(robot, joint, position); !why.empty()) {
            throw Error(ErrorCode::usage, fmt::format("lock_joints: {}", why));
        }
    }
    give_tool_frame(facts, robot, writer, into);
}

/// Throws Error(usage) if the stage has not all of the parameters.
void require_declared(const Given& parameters, const StageInfo& info) {
    for (const auto& [name, value] : parameters) {
        const auto declared = std::find_if(info.parameters.begin(), info.parameters.end(),
                                           [&, &key = name](const Parameter& p) { return p.name == key; });
        if (declared == info.parameters.end()) {
            throw Error(ErrorCode::usage, fmt::format("{} has no parameter '{}'; foam.describe(\"{}\") lists them",
                                                      info.name, name, info.name));
        }
    }
}

/// Returns the files with their bytes, and what the writer warns of; nothing is written.
py::tuple written(const std::shared_ptr<Registry>& registry, SphereFile spheres, const HeldRobot* robot,
                  const HeldModel* of_run, const std::filesystem::path& file, const std::string& format,
                  const std::optional<std::pair<std::filesystem::path, std::string>>& into, const Given& parameters,
                  const RobotFacts& facts) {
    const StageInfo& info =
        writer_for(format.empty() ? file.extension().string().substr(file.has_extension()) : format, *registry).info;
    if (into && !info.consumer.edits) {
        throw Error(ErrorCode::usage, fmt::format("{} writes whole files; remedy: without into", info.name));
    }
    require_declared(parameters, info);
    std::vector<WrittenFile> files;
    Warnings warnings;
    work_aside(
        [&](const std::atomic<bool>& cancel) {
            const auto writer = registry->make<Writer>(info.name, parameters);
            const Original* original = robot ? &robot->original : nullptr;
            name_only_link(spheres, original);
            SphereModel model;
            if (of_run && !info.consumer.float32) {
                model = of_run->model;
            } else {
                if (original) {
                    require_links(spheres, *original->robot);
                }
                model = sphere_model_of(spheres, original ? original->robot : links_alone(spheres));
            }
            if (original) {
                for (const OriginalLink& link : original->links) {
                    model.geometry[link.link] = link.solid;
                }
            }
            model.facts = facts;
            if (model.robot) {
                complete_facts(model.facts, *model.robot, info, into.has_value());
            }
            const bool judged = !of_run || info.consumer.float32 || info.consumer.rest_pose ||
                                lists_pairs(info, parameters, into.has_value());
            if (judged) {
                complete(model, spheres, original, info, parameters, into.has_value(), cancel);
            }
            if (into) {
                model.into = TextFile{into->first, into->second};
            }
            if (judged) {
                files = judged_files(*writer, info, model, original, spheres, file, warnings).files;
                return;
            }
            files = written_files(*writer, info, model, file, warnings);
            require_written(model, *writer, info, files);
        },
        [] {});
    py::list list;
    for (const WrittenFile& one : files) {
        list.append(py::make_tuple(one.file, py::bytes(one.bytes)));
    }
    return py::make_tuple(list, warnings.messages);
}

RobotFacts facts_of(const std::string& base_link, const std::vector<std::string>& tool_frames,
                    const JointValues& locked, const JointValues& pose) {
    return {.base_link = base_link,
            .tool_frames = tool_frames,
            .lock_joints = locked,
            .default_pose = pose,
            .acceleration = {},
            .jerk = {}};
}

} // namespace

void add_writing(py::module_& module) {
    py::class_<RobotFacts>(module, "Facts")
        .def(py::init(&facts_of), py::arg("base_link"), py::arg("tool_frames"), py::arg("lock_joints"),
             py::arg("default_pose"));
    module.def("written", &written, py::arg("registry"), py::arg("spheres"), py::arg("robot").none(true),
               py::arg("of_run").none(true), py::arg("file"), py::arg("format"), py::arg("into"), py::arg("parameters"),
               py::arg("facts"));
}

} // namespace foam::python
