#include <foam/view/subject.hpp>

#include "session_work.hpp"

#include <foam/base/error.hpp>
#include <foam/base/file.hpp>
#include <foam/base/internal/files.hpp>
#include <foam/base/text.hpp>
#include <foam/judge/evaluate.hpp>
#include <foam/judge/written_model.hpp>
#include <foam/recipe/internal/glob.hpp>
#include <foam/xml/document.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace foam::inline view {
namespace {

/// Returns whether the file is a URDF by its content, or, as the first of all, of another format of robots: of those a
/// later one is a model.
bool is_robot_file(const std::filesystem::path& file, bool first, const Registry& registry) {
    const std::string ending = extension_of(file);
    if (ending == "urdf" || ending == "xacro") {
        return true;
    }
    if (!registry.find_for_extension(StageKind::robot_loader, ending)) {
        return false;
    }
    const std::string text = read_file(file, most_robot_bytes);
    return xml::root_name(text) == "robot" ||
           (first && !registry.robot_loaders_of(text).empty());
}

/// Returns the names of links that may have spheres, as match() needs them: without their geometry.
Original names_of(const ViewedRobot& robot) {
    Original names;
    names.file = robot.file;
    names.robot = robot.robot;
    for (const Link& link : robot.robot->links) {
        names.links.push_back({link.name, nullptr});
    }
    return names;
}

/// Returns the names of the only link that spheres without link names can belong to, or of all.
Original names_for(const ViewedRobot& robot, const SphereFile& file) {
    Original names = names_of(robot);
    const bool nameless =
        std::any_of(file.links.begin(), file.links.end(), [](const LinkSpheres& l) { return l.link.empty(); });
    if (nameless) {
        std::erase_if(names.links,
                      [&](const OriginalLink& link) { return robot.robot->find_link(link.link)->collisions.empty(); });
    }
    return names;
}

std::size_t count_of(const std::vector<LinkSpheres>& links) {
    std::size_t count = 0;
    for (const LinkSpheres& link : links) {
        count += link.elements.spheres().size();
    }
    return count;
}

std::size_t count_of(const std::vector<std::vector<Sphere>>& links) {
    std::size_t count = 0;
    for (const std::vector<Sphere>& link : links) {
        count += link.size();
    }
    return count;
}

class SubjectLoader {
public:
    SubjectLoader(const SubjectOptions& options, const Registry& registry) : options_(options), registry_(registry) {}

    Subject load() {
        for (const std::filesystem::path& file : options_.files) {
            add(file);
        }
        for (std::size_t r = 0; r < subject_.robots.size(); ++r) {
            const auto of_robot = [r](const ViewedModel& model) { return model.robot == r; };
            if (std::none_of(subject_.models.begin(), subject_.models.end(), of_robot)) {
                ViewedModel none{.file = {}, .format = {}, .robot = r, .spheres = {}};
                none.spheres.resize(subject_.robots[r].robot->links.size());
                subject_.models.push_back(std::move(none));
            }
        }
        return std::move(subject_);
    }

private:
    void add(const std::filesystem::path& file) {
        const bool first = subject_.robots.empty();
        if (is_robot_file(file, first, registry_) || (first && is_mesh_file(file, registry_))) {
            add_robot(file);
            return;
        }
        SphereFile spheres = read(file);
        if (first) {
            rename_links(spheres, options_.renames);
            name_only_link(spheres, nullptr);
            subject_.robots.push_back(robot_of_names(spheres));
            require_choices(options_.choices, *subject_.robots.back().robot);
            subject_.notes.push_back(fmt::format("{}: without its robot all links lie in one frame, and nothing is "
                                                 "proved; remedy: foam view ROBOT MODEL",
                                                 shown(file.string())));
        }
        add_model(file, std::move(spheres), first ? Renames{} : options_.renames);
    }

    /// A URDF is a sphere model of the robot before it if they share a link; otherwise, it is a robot.
    void add_robot(const std::filesystem::path& file) {
        ViewedRobot robot = load_robot(file, options_, registry_, subject_.notes);
        if (subject_.robots.empty()) { // of several robots the first must have what is chosen
            require_choices(options_.choices, *robot.robot);
        }
        if (has_spheres(*robot.robot) && !subject_.robots.empty() &&
            shares_a_link(subject_.robots.back(), *robot.robot)) {
            add_model(file, read(file), options_.renames);
            return;
        }
        const bool model = is_sphere_model(*robot.robot);
        if (!model && !robot.judged) {
            subject_.notes.push_back(
                fmt::format("{} has no {}: nothing is searched or proved; remedy: another --geometry",
                            shown(file.string()), to_string(options_.geometry)));
        }
        subject_.robots.push_back(std::move(robot));
        if (model) {
            add_model(file, read(file), {});
        }
    }

    SphereFile read(const std::filesystem::path& file) const {
        return read_sphere_file(file, registry_, options_.reader, Radii::as_used,
                                file == options_.nameless ? options_.nameless_name : std::filesystem::path());
    }

    static bool has_spheres(const Robot& robot) {
        return std::any_of(robot.links.begin(), robot.links.end(), [](const Link& link) {
            return std::any_of(link.collisions.begin(), link.collisions.end(), is_sphere);
        });
    }

    bool shares_a_link(const ViewedRobot& before, const Robot& robot) const {
        if (!options_.renames.empty()) {
            return true;
        }
        return std::any_of(robot.links.begin(), robot.links.end(), [&](const Link& link) {
            return !link.collisions.empty() && before.robot->find_link(link.name);
        });
    }

    void add_model(const std::filesystem::path& file, SphereFile spheres, const Renames& renames) {
        if (std::any_of(spheres.links.begin(), spheres.links.end(),
                        [](const LinkSpheres& link) { return !link.elements.are_spheres(); })) {
            throw Error(ErrorCode::input,
                        fmt::format("{}: it has elements of other kinds than sphere, which foam view does "
                                    "not show as a model; remedy: convert it to a URDF, and view that",
                                    shown(file.string())));
        }
        const ViewedRobot& robot = subject_.robots.back();
        ViewedModel model{.file = file, .format = spheres.format, .robot = subject_.robots.size() - 1, .spheres = {}};
        const Original names = names_for(robot, spheres);
        MatchedModel matched = match(names, std::move(spheres), renames);
        model.spheres.resize(robot.robot->links.size());
        for (std::size_t i = 0; i < names.links.size(); ++i) {
            model.spheres[link_index(*robot.robot, names.links[i].link)] = std::move(matched.elements[i].spheres());
        }
        for (const std::string& note : matched.file.notes) {
            subject_.notes.push_back(fmt::format("{}: {}", shown(file.filename().string()), shown(note)));
        }
        if (const std::size_t lost = count_of(matched.file.links) - count_of(model.spheres); lost > 0) {
            subject_.notes.push_back(fmt::format("{}: {} sphere{} of links that {} does not have {} not shown; remedy: "
                                                 "--rename OLD=NEW if only the names differ",
                                                 shown(file.filename().string()), lost, lost == 1 ? "" : "s",
                                                 shown(robot.file.filename().string()), lost == 1 ? "is" : "are"));
        }
        subject_.models.push_back(std::move(model));
    }

    const SubjectOptions& options_;
    const Registry& registry_;
    Subject subject_;
};

} // namespace

Subject load_subject(const SubjectOptions& options, const Registry& registry) {
    if (options.files.empty()) {
        throw Error(ErrorCode::usage, "there is nothing to show; remedy: foam view ROBOT, or foam view ROBOT MODEL");
    }
    return SubjectLoader(options, registry).load();
}

std::vector<std::filesystem::path> inputs_of(const Subject& subject, const SubjectOptions& options) {
    std::vector<std::filesystem::path> inputs = options.files;
    if (!options.srdf.empty()) {
        inputs.push_back(options.srdf);
    }
    for (const ViewedRobot& robot : subject.robots) {
        for (const Link& link : robot.robot->links) {
            for (const auto* elements : {&link.visuals, &link.collisions}) {
                for (const GeometryElement& element : *elements) {
                    const auto* mesh = std::get_if<MeshReference>(&element.geometry);
                    if (mesh && !mesh->path.empty()) {
                        inputs.push_back(mesh->path);
                    }
                }
            }
        }
    }
    return inputs;
}

Original original_of(const ViewedRobot& robot, const SubjectOptions& options, const Registry& registry) {
    std::vector<std::string> judged; // globs; none: all
    for (std::size_t l = 0; l < robot.links.size() && options.choices != RobotChoices{}; ++l) {
        if (robot.links[l].judged) {
            judged.push_back(glob_of_name(robot.robot->links[l].name));
        }
    }
    return original_of(robot.loaded, registry, {.links = std::move(judged), .geometry = options.geometry});
}

} // namespace foam::inline view
