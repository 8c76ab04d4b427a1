#include "judge.hpp"

#include "commands.hpp"

#include <foam/base/error.hpp>
#include <foam/base/file.hpp>
#include <foam/base/text.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace foam::cli {
Renames renames_of(const std::vector<std::string>& texts) {
    Renames renames;
    for (const std::string& text : texts) {
        const std::size_t equals = text.find('=');
        if (equals == text.npos) {
            throw Error(ErrorCode::usage, fmt::format("--rename expects OLD=NEW, got '{}'", text));
        }
        renames.emplace_back(text.substr(0, equals), text.substr(equals + 1));
    }
    return renames;
}

void add_renames(CLI::App& command, std::vector<std::string>& texts) {
    command
        .add_option("--rename", texts,
                    "Rename links of MODEL to match ORIGINAL: the name or prefix OLD becomes NEW; '=LINK' for elements "
                    "without a link name; repeatable")
        ->type_name("OLD=NEW")
        ->expected(1)
        ->take_all();
}

CLI::Option* add_reader(CLI::App& command, std::string& reader) {
    return command
        .add_option("--reader", reader,
                    "Stage that reads MODEL, such as read.curobo; default: the one that recognises the file")
        ->type_name("STAGE");
}

void add_covers(CLI::App& command, std::string& covers, const std::string& text) {
    command.add_option("--covers", covers, text)
        ->type_name("WHAT")
        ->check(CLI::IsMember({to_string(Covers::solid), to_string(Covers::surface)}).description(""))
        ->capture_default_str();
}

Covers covers_named(const std::string& word) {
    return word == to_string(Covers::surface) ? Covers::surface : Covers::solid;
}

double size_of(const Original& original) {
    const std::map<std::string, Pose> poses = link_poses(*original.robot);
    Box box;
    for (const OriginalLink& link : original.links) {
        const auto pose = poses.find(link.link);
        for (const Vec3& corner : link.solid->surface().vertices) {
            box.add(pose == poses.end() ? corner : pose->second * corner);
        }
    }
    const Vec3 edges = box.empty() ? Vec3{} : box.size();
    return std::max({edges.x, edges.y, edges.z});
}

/// Returns the longest edge of the boxes around the elements of a link, m.
static double size_of_links(const SphereFile& file) {
    double longest = 0;
    for (const LinkSpheres& link : file.links) {
        Box box;
        for (const Element& element : link.elements) {
            box.add(bounds(element));
        }
        const Vec3 edges = box.empty() ? Vec3{} : box.size();
        longest = std::max({longest, edges.x, edges.y, edges.z});
    }
    return longest;
}

void pad(SphereFile& file, const RobotOptions& options, const Original* original) {
    const std::optional<QuickLength> padding = pad_of(options);
    if (!padding) {
        return;
    }
    question_length("--pad", options.pad, original ? size_of(*original) : size_of_links(file),
                    original ? "the robot" : "the largest link");
    for (LinkSpheres& link : file.links) {
        for (Sphere& s : link.elements.spheres()) {
            s.radius += padding->metres;
        }
        for (Element& element : link.elements.shaped()) {
            element = grown(element, padding->metres);
        }
    }
}

void add_judge_options(CLI::App& command, Program& program, JudgeOptions& options) {
    command.add_option("original", options.original,
                       "The geometry: a robot (URDF, xacro, MJCF, SDF, USD) or a mesh; - is the standard input")
        ->type_name("ORIGINAL")
        ->required();
    program.standard_input.may_be(options.original, StandardInput::Holds::geometry);
    program.standard_input.add_format(command);
    using enum RobotOption;
    add_robot_options(command, options.robot, {geometry, keep, skip, RobotOption::pad});
    command
        .add_option_function<std::vector<std::string>>(
            "--link",
            [&options](const std::vector<std::string>& globs) {
                options.robot.keep.insert(options.robot.keep.end(), globs.begin(), globs.end());
            },
            "The old spelling of --keep")
        ->expected(1)
        ->take_all()
        ->group(""); // not in the help
    add_covers(command, options.covers,
               "What is asked of the elements: solid, with the inside of what is closed, or surface alone");
    add_packages(command, options.packages);
    add_mesh_unit(command, options.unit);
    add_reader(command, options.reader);
    add_renames(command, options.renames);
    add_threads(command, options.threads);
}

Original original_of(Program& program, const JudgeOptions& options) {
    const RobotChoices choices = choices_of(options.robot);
    Original original = load_original(options.original, program.registry(),
                                      {.links = choices.keep,
                                       .unit = options.unit,
                                       .geometry = covered_geometry(options.robot.geometry),
                                       .covers = covers_named(options.covers),
                                       .package_path = package_path_of(options.packages),
                                       .name = program.standard_input.name_of(options.original),
                                       .skip = choices.skip,
                                       .held = choices.locks});
    for (const std::string& note : original.notes) {
        tell(fmt::format("warning: {}: {}", options.original, note));
    }
    return original;
}

MatchedModel model_of(Program& program, const JudgeOptions& options, const Original& original, const std::string& file,
                      bool alone) {
    SphereFile spheres = read_sphere_file(file, program.registry(), options.reader, Radii::as_used,
                                          program.standard_input.name_of(file));
    if (alone) {
        require_renames(options.renames, {&spheres});
    }
    pad(spheres, options.robot, &original);
    MatchedModel model = match(original, std::move(spheres), renames_of(options.renames));
    for (const std::string& note : model.notes) {
        tell(fmt::format("warning: {}: {}", file, note));
    }
    return model;
}

void require_renames(const std::vector<std::string>& renames, const std::vector<const SphereFile*>& files) {
    std::vector<std::string> names;
    for (const SphereFile* file : files) {
        for (const LinkSpheres& link : file->links) {
            names.push_back(link.link);
        }
        for (const auto& [link, joint] : file->fixed_joints) {
            names.push_back(link);
            names.push_back(joint.parent);
        }
    }
    for (const auto& [old, name] : renames_of(renames)) {
        const auto begins = [&, &old = old](const std::string& link) {
            return old.empty() ? link.empty() : link.starts_with(old);
        };
        if (std::none_of(names.begin(), names.end(), begins)) {
            const std::string near = nearest_word(old, names);
            throw Error(ErrorCode::usage,
                        fmt::format("--rename {0}={1}: no link of the spheres is called '{0}' or begins with it{2}",
                                    shown(old), shown(name),
                                    near.empty() ? "" : fmt::format("; did you mean '{}'?", shown(near))));
        }
    }
}

std::string certified_cell(const ProvedLinks& links) {
    return links.all() ? "yes" : links.proved > 0 ? "in part" : "no";
}

std::string not_judged_text(ProvedLinks links) {
    std::erase_if(links.left_out, [](const ProvedLinks::LeftOut& link) {
        return link.reason == proof_fails || link.reason == no_elements;
    });
    return omissions_of(links);
}

void write_whole_file(const std::filesystem::path& file, const std::string& text) {
    if (replace_file(file, text)) {
        throw Error(ErrorCode::output, fmt::format("{}: it cannot be written; remedy: check that its folder exists and "
                                                   "has room",
                                                   file.string()));
    }
}

std::string millimetres(double metres, int digits) {
    return figure_text(1000 * metres, digits);
}

KindCounts kinds_of_model(const MatchedModel& model) {
    KindCounts kinds{};
    for (std::size_t link = 0; link < model.elements.size(); ++link) {
        kinds = sum_of(kinds, kinds_of(model.elements[link]));
    }
    return kinds;
}

} // namespace foam::cli
