// For authors of plugins: a little project to start from.
#include "cli/program.hpp"
#include "commands.hpp"

#include <foam/base/error.hpp>
#include <foam/base/text.hpp>
#include <foam/runtime/scratch_folder.hpp>
#include <foam/sdk/sdk.hpp>

#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <regex>

namespace foam::cli {
namespace {

namespace fs = std::filesystem;

/// Kind of stage as names begin with it, the folder of templates that makes one, and how its classes are called.
struct Kind {
    const char *name, *templates, *noun;
};
constexpr std::array<Kind, 8> stage_kinds{{{"load", "load", "Loader"},
                                     {"read", "read", "Reader"},
                                     {"refine", "refine", "Refiner"},
                                     {"repair", "filter", "Filter"},
                                     {"simplify", "filter", "Filter"},
                                     {"smooth", "filter", "Filter"},
                                     {"spherize", "spherize", "Spherizer"},
                                     {"write", "write", "Writer"}}};

struct Project {
    std::string stage, plugin, method, class_name;
    fs::path templates; ///< of its kind
};

std::string camel_case(const std::string& words) {
    std::string result;
    bool upper = true;
    for (const char c : words) {
        if (c == '_') {
            upper = true;
        } else {
            result += upper && c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
            upper = false;
        }
    }
    return result;
}

Kind kind_of(const std::string& name, const std::string& method) {
    std::vector<std::string> names;
    for (const Kind& kind : stage_kinds) {
        if (name == kind.name) {
            return kind;
        }
        names.emplace_back(kind.name);
    }
    const std::string near = nearest_word(name, names);
    throw Error(ErrorCode::usage, fmt::format("unknown kind '{}'{}; there are: {}", name,
                                              near.empty() ? "" : fmt::format("; did you mean '{}.{}'?", near, method),
                                              fmt::join(names, ", ")));
}

Project project_of(const std::string& stage, const Registry& registry) {
    static const std::regex form("([a-z][a-z0-9]*)\\.([a-z][a-z0-9_]*)");
    std::smatch parts;
    if (!std::regex_match(stage, parts, form)) {
        throw Error(ErrorCode::usage,
                    fmt::format("'{}' is not of the form kind.method (lower-case letters, digits, _), "
                                "e.g. spherize.mine",
                                stage));
    }
    const std::string method = parts[2];
    const Kind kind = kind_of(parts[1], method);
    if (const RegisteredStage* other = registry.find(stage)) {
        throw Error(ErrorCode::usage, fmt::format("there is a stage '{}' already, from plugin {}; remedy: another name",
                                                  stage, other->plugin));
    }
    return {stage, fmt::format("{}_{}", kind.name, method), method, camel_case(method) + kind.noun,
            sdk_prefix() / "share/foam/templates" / kind.templates};
}

std::string contents(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    if (!stream) {
        throw Error(ErrorCode::input,
                    fmt::format("{}: it cannot be read; remedy: install the SDK again", file.string()));
    }
    return {std::istreambuf_iterator<char>(stream), {}};
}

void replace_all(std::string& text, const std::string& what, const std::string& by) {
    for (std::size_t at = 0; (at = text.find(what, at)) != text.npos; at += by.size()) {
        text.replace(at, what.size(), by);
    }
}

/// Fills in a template.
std::string filled(std::string text, const Project& project) {
    if (text.find("@more@") != text.npos) {
        replace_all(text, "@more@\n", contents(project.templates / "more.md") + "\n");
    }
    replace_all(text, "@stage@", project.stage);
    replace_all(text, "@plugin@", project.plugin);
    replace_all(text, "@method@", project.method);
    replace_all(text, "@class@", project.class_name);
    return text;
}

void write_file(const fs::path& file, const std::string& text) {
    std::ofstream stream(file, std::ios::binary);
    stream << text;
    stream.close();
    if (!stream) {
        throw Error(ErrorCode::output, fmt::format("{}: it cannot be written", file.string()));
    }
}

/// The files of the project; what its kind has replaces what is common to all.
void write_project(const fs::path& folder, const Project& project) {
    const bool own_sample = fs::exists(project.templates / "part.txt");
    for (const fs::path& source : {project.templates.parent_path() / "common", project.templates}) {
        for (const fs::directory_entry& entry : fs::directory_iterator(source)) {
            std::string name = entry.path().filename().string();
            const bool replaced = source != project.templates && fs::exists(project.templates / name);
            if (name == "more.md" || replaced) {
                continue;
            }
            name = name == "gitignore" ? ".gitignore" : name == "part.txt" ? "part." + project.method : name;
            write_file(folder / name, filled(contents(entry.path()), project));
        }
    }
    if (!own_sample) {
        write_file(folder / "part.obj", contents(sdk_prefix() / "share/foam/configs/robots/panda/meshes/link5.obj"));
    }
}

std::string shell_quoted(const std::string& text) {
    static const std::regex plain("[A-Za-z0-9_./+@:-]+");
    if (std::regex_match(text, plain)) {
        return text;
    }
    std::string inner = text;
    replace_all(inner, "'", "'\\''");
    return "'" + inner + "'";
}

int new_plugin(Program& program, const std::string& stage, const std::string& directory) {
    const Project project = project_of(stage, program.registry(false));
    const fs::path target = directory.empty() ? fs::path(project.plugin) : fs::path(directory);
    const fs::path full = fs::absolute(target).lexically_normal();
    const fs::path parent = full.has_filename() ? full.parent_path() : full.parent_path().parent_path();
    if (fs::exists(target)) {
        throw Error(ErrorCode::usage,
                    fmt::format("{}: it exists already; remedy: another folder by --dir", target.string()));
    }
    const ScratchFolder scratch(parent);
    const fs::path made = scratch.path() / project.plugin;
    fs::create_directory(made);
    write_project(made, project);
    fs::rename(made, full.has_filename() ? full : full.parent_path()); // in one step: there is never half a project
    const std::string folder = shell_quoted(target.string()), build = shell_quoted((target / "build").string());
    print(fmt::format("{} is written. Next:\n"
                      "  cmake -S {} -B {} -DCMAKE_PREFIX_PATH={}\n"
                      "  cmake --build {}\n"
                      "  ctest --test-dir {} --output-on-failure\n"
                      "{}/README.md has the details.\n",
                      target.string(), folder, build, shell_quoted(sdk_prefix().string()), build, build, folder));
    return 0;
}

} // namespace

void add_new_plugin(Program& program) {
    CLI::App* command = add_command(program, "new-plugin", "Create a plugin project with test and recipe",
                                    "  foam new-plugin spherize.mine\n"
                                    "  foam new-plugin smooth.mine --dir ~/plugins/smooth_mine");
    auto stage = std::make_shared<std::string>(), directory = std::make_shared<std::string>();
    command
        ->add_option(
            "stage", *stage,
            "Name of the stage, kind.method; kinds: load (meshes), read (sphere models), refine (spheres), repair, "
            "simplify, smooth, spherize, write")
        ->type_name("STAGE")
        ->required();
    command->add_option("--dir", *directory, "Folder of the project; default: ./KIND_METHOD")->type_name("DIR");
    command->callback([&program, stage, directory] {
        program.action = [&program, stage, directory] { return new_plugin(program, *stage, *directory); };
    });
}

} // namespace foam::cli
