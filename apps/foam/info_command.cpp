// foam info: what a file holds.
#include "commands.hpp"
#include "judge.hpp"

#include <foam/base/parallel.hpp>
#include <foam/base/text.hpp>
#include <foam/recipe/quick_recipe.hpp>

#include <fmt/format.h>

namespace foam::cli {
namespace {

struct InfoArguments {
    JudgeOptions input;
    bool json = false;
};

/// The figures of one link's geometry.
struct LinkInfo {
    std::string link;
    std::size_t elements = 0, triangles = 0;
    bool closed = false;
    double volume = 0; ///< m³
    Vec3 size{};       ///< of the bounds in the link's frame, m
};

LinkInfo info_of(const OriginalLink& link) {
    const Solid& solid = *link.solid;
    return {link.link,      solid.parts().size(), solid.surface().triangles.size(),
            solid.closed(), solid.volume(),       solid.bounds().size()};
}

std::vector<LinkInfo> infos_of(const Original& original) {
    std::vector<LinkInfo> infos;
    for (const OriginalLink& link : original.links) {
        infos.push_back(info_of(link));
    }
    return infos;
}

std::size_t moving_joints(const Robot& robot) {
    return static_cast<std::size_t>(std::count_if(robot.joints.begin(), robot.joints.end(),
                                                  [](const Joint& joint) { return joint.kind != Joint::Kind::fixed; }));
}

/// Returns a remark on a size that is unusual for metres; empty for a usual one.
std::string remark_on_unit(double diagonal) {
    constexpr double large = 20, small = 1e-3; // m; the bounds of the warning of runs
    if (diagonal > large) {
        return fmt::format("The size of {} m is unusual; if the file is in millimetres, use --unit mm.",
                           figure_text(diagonal, 3));
    }
    if (diagonal < small) {
        return fmt::format("The size of {} mm is unusual; use --unit or --scale if the file is not in metres.",
                           figure_text(1000 * diagonal, 3));
    }
    return {};
}

std::string size_text(const Vec3& size) {
    return fmt::format("{} x {} x {}", millimetres(size.x, 1), millimetres(size.y, 1), millimetres(size.z, 1));
}

std::string table_of_links(const std::vector<LinkInfo>& infos) {
    const std::size_t width = column_width("link", infos, &LinkInfo::link);
    std::string table = fmt::format("{:<{}}  {:>5}  {:>9}  {:>6}  {:>10}  {}\n", "link", width, "parts", "triangles",
                                    "closed", "volume cm3", "size mm");
    for (const LinkInfo& info : infos) {
        table += fmt::format("{}  {:>5}  {:>9}  {:>6}  {:>10}  {}\n", padded(info.link, width), info.elements,
                             info.triangles, info.closed ? "yes" : "no", figure_text(1e6 * info.volume, 1),
                             size_text(info.size));
    }
    return table;
}

std::string text_of(const Original& original, const std::vector<LinkInfo>& infos, bool mesh) {
    if (mesh) {
        const LinkInfo& info = infos.front();
        const Mesh& surface = original.links.front().solid->surface();
        std::string text =
            fmt::format("A mesh: {}, {}\nSize: {} mm\nVolume: {} cm3, surface: {} cm2\n", counted(info.triangles, "triangle"),
                        describe(topology(welded(surface))), size_text(info.size), figure_text(1e6 * info.volume, 1),
                        figure_text(1e4 * original.links.front().solid->area(), 1));
        const std::string remark = remark_on_unit(norm(info.size));
        return remark.empty() ? text : text + remark + "\n";
    }
    const Robot& robot = *original.robot;
    return fmt::format("Robot {}: {}, {} with {}; {}, {} that move\n", shown(robot.name),
                       counted(robot.links.size(), "link"), infos.size(), to_string(original.geometry),
                       counted(robot.joints.size(), "joint"), moving_joints(robot)) +
           table_of_links(infos);
}

nlohmann::ordered_json json_of(const Original& original, const std::vector<LinkInfo>& infos, bool mesh) {
    nlohmann::ordered_json json{{"file", original.file.string()}, {"kind", mesh ? "mesh" : "robot"}};
    if (!mesh) {
        json["robot"] = original.robot->name;
        json["links_in_robot"] = original.robot->links.size();
        json["joints"] = original.robot->joints.size();
        json["joints_that_move"] = moving_joints(*original.robot);
    }
    json["links"] = nlohmann::ordered_json::array();
    for (const LinkInfo& info : infos) {
        json["links"].push_back({{"link", info.link},
                                 {"parts", info.elements},
                                 {"triangles", info.triangles},
                                 {"closed", info.closed},
                                 {"volume_m3", info.volume},
                                 {"size_m", {info.size.x, info.size.y, info.size.z}}});
    }
    return json;
}

int inform(Program& program, const InfoArguments& arguments) {
    const ThreadLimit limit(arguments.input.threads);
    const Original original = original_of(program, arguments.input);
    const bool mesh = is_mesh(arguments.input.original, program.registry());
    const std::vector<LinkInfo> infos = infos_of(original);
    if (arguments.json) {
        print_json(json_of(original, infos, mesh));
    } else {
        print(text_of(original, infos, mesh));
    }
    return 0;
}

} // namespace

void add_info(Program& program) {
    CLI::App* command = add_command(program, "info", "Show what a robot or a mesh consists of",
                                    "  foam info robot.urdf\n"
                                    "  foam info part.stl --unit mm\n"
                                    "\n"
                                    "closed: no if a mesh of the link has holes; its volume is then that of\n"
                                    "the points whose winding number is above one half.");
    auto arguments = std::make_shared<InfoArguments>();
    command->add_option("input", arguments->input.original,
                        "A robot (URDF, xacro, MJCF, SDF, USD) or a mesh; - is the standard input")
        ->type_name("INPUT")
        ->required();
    program.standard_input.may_be(arguments->input.original, StandardInput::Holds::geometry);
    program.standard_input.add_format(*command);
    using enum RobotOption;
    add_robot_options(*command, arguments->input.robot, {geometry, keep, skip});
    add_packages(*command, arguments->input.packages);
    add_mesh_unit(*command, arguments->input.unit);
    add_threads(*command, arguments->input.threads);
    command->add_flag("--json", arguments->json, "Print the figures as JSON");
    command->callback(
        [&program, arguments] { program.action = [&program, arguments] { return inform(program, *arguments); }; });
}

} // namespace foam::cli
