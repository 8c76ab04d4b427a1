#include <foam/runtime/internal/reading.hpp>

#include <foam/base/file.hpp>
#include <foam/base/text.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace foam::inline runtime {
namespace fs = std::filesystem;
namespace {

/// Returns a robot with one link whose geometry is the mesh.
Robot robot_of_mesh(const fs::path& file, const std::string& reference, double scale) {
    Robot robot;
    robot.name = file.stem().string();
    robot.root = robot.name;
    robot.file = file;
    Link link;
    link.name = robot.name;
    GeometryElement element;
    element.geometry = MeshReference{reference, file, {scale, scale, scale}};
    link.collisions = {element};
    link.visuals = {element};
    robot.links = {link};
    return robot;
}

/// Returns the name of a single mesh in outputs: a URI as written; of a path only the file's name, so that the same
/// recipe gives the same bytes in every folder.
std::string portable_reference(const LoadedInput& input) {
    return input.chosen.find("://") != std::string::npos ? input.chosen : input.file.filename().string();
}

/// Returns the value of a loader's parameter max_bytes; nothing if it has none.
std::optional<std::int64_t> max_bytes(const Reading& reading, const RegisteredStage& loader) {
    const auto given = reading.call(loader.info.name).given;
    for (const Parameter& parameter : loader.info.parameters) {
        if (parameter.name == "max_bytes" && parameter.type == Parameter::Type::integer) {
            const auto value = given.find(parameter.name);
            return std::get<std::int64_t>(value == given.end() ? parameter.default_value : value->second);
        }
    }
    return std::nullopt;
}

DigestedFile digest_of_mesh(const Registry& registry, const Reading& reading, const fs::path& file) {
    const RegisteredStage* loader = mesh_loader_of(registry, reading, file);
    const auto limit = loader ? max_bytes(reading, *loader) : std::nullopt;
    return limit ? digest_of_file(file, static_cast<std::uintmax_t>(*limit),
                                  fmt::format("simplify the mesh, or raise max_bytes of {}", loader->info.name))
                 : digest_of_file(file);
}

/// Returns the loader that recognises the text; of several the preferred one, then that of the file name's ending. Where
/// none does, that of the ending, or of URDFs, says what is wrong with it.
const RegisteredStage& robot_loader_of(const Registry& registry, const Reading& reading, const fs::path& file,
                                       std::string_view text) {
    const RegisteredStage* of_ending = registry.find_for_extension(StageKind::robot_loader, extension_of(file));
    const RegisteredStage* loader = nullptr;
    const auto rank = [&](const RegisteredStage& stage) {
        return stage.info.name == reading.preferred_loader ? 2 : &stage == of_ending ? 1 : 0;
    };
    for (const RegisteredStage* stage : registry.robot_loaders_of(text)) {
        loader = !loader || rank(*stage) > rank(*loader) ? stage : loader;
    }
    for (const std::string& ending : {extension_of(file), std::string("urdf")}) {
        loader = loader ? loader : registry.find_for_extension(StageKind::robot_loader, ending);
    }
    if (!loader) {
        throw Error(ErrorCode::plugin, "no plugin can read URDF files; `foam plugins --why` shows which plugins were "
                                       "loaded, and why others were not");
    }
    return *loader;
}

void read_mesh(const Calls& calls, const Reading& reading, LoadedInput& input) {
    const DigestedFile digested = digest_of_mesh(calls.registry, reading, input.file);
    input.digest = digested.digest;
    input.bytes = digested.bytes;
    input.robot =
        std::make_shared<const Robot>(robot_of_mesh(input.file, portable_reference(input), reading.unit.factor()));
}

/// Throws Error(usage) for a package that the user named and no reference has.
void require_named_packages(const Reading& reading, const LoadedInput& input) {
    std::vector<std::string> used{package_of(input.chosen)};
    for (const Link& link : input.robot->links) {
        for (const auto* elements : {&link.collisions, &link.visuals}) {
            for (const GeometryElement& element : *elements) {
                const auto* mesh = std::get_if<MeshReference>(&element.geometry);
                used.push_back(mesh ? package_of(mesh->uri) : "");
            }
        }
    }
    for (const auto& [name, folder] : reading.resources.named_packages()) {
        if (!fs::is_directory(folder)) {
            throw Error(ErrorCode::input, fmt::format("package {}: there is no folder {}", name, folder.string()));
        }
        if (std::find(used.begin(), used.end(), name) == used.end()) {
            const std::string near = nearest_word(name, used);
            throw Error(ErrorCode::usage, fmt::format("no mesh of {} is in a package '{}'{}", input.file.string(), name,
                                                      near.empty() ? "" : fmt::format("; did you mean '{}'?", near)));
        }
    }
}

void read_robot(const Calls& calls, const Reading& reading, LoadedInput& input) {
    const std::string text = read_file(input.file, most_robot_bytes);
    input.digest = digest_of(text);
    input.bytes = text.size();
    const std::string loader = robot_loader_of(calls.registry, reading, input.file, text).info.name;
    const fs::path name = reading.name.empty() ? input.file : reading.name;
    input.robot = std::make_shared<const Robot>(
        run_stage(calls, loader, "", name.string(), input.digest, input.report, [&](StageContext& context) {
            const auto stage = calls.registry.make<RobotLoader>(loader, reading.call(loader).given);
            Robot robot = stage->load(text, name, reading.resources, context);
            input.log = context.kept_log();
            return robot;
        }));
    require_named_packages(reading, input);
}

} // namespace

const RegisteredStage* mesh_loader_of(const Registry& registry, const Reading& reading, const fs::path& file) {
    return registry.find_for_extension(StageKind::mesh_loader, extension_of(file), reading.preferred_loader);
}

const fs::path& path_of(const MeshReference& reference) {
    if (reference.path.empty()) {
        throw Error(ErrorCode::input, !reference.problem.empty()
                                          ? reference.problem
                                          : fmt::format("the mesh '{}' is not found; remedy: correct the path, or set "
                                                        "FOAM_PACKAGE_PATH to the folder that holds the package",
                                                        reference.uri));
    }
    return reference.path;
}

InputFile mesh_file_of(const Registry& registry, const Reading& reading, const MeshReference& reference) {
    const DigestedFile digested = digest_of_mesh(registry, reading, path_of(reference));
    return {reference.uri, reference.path, digested.digest, digested.bytes};
}

LoadedInput read_input(const Calls& calls, const Reading& reading, const fs::path& file, InputKind kind,
                       const std::string& chosen) {
    if (const std::string why = why_refused(reading.unit, file, kind, calls.registry, reading.preferred_loader);
        !why.empty()) {
        throw Error(ErrorCode::usage, why);
    }
    LoadedInput input;
    input.chosen = chosen;
    input.file = file;
    input.report.input = file.filename().string();
    kind == InputKind::mesh ? read_mesh(calls, reading, input) : read_robot(calls, reading, input);
    return input;
}

} // namespace foam::inline runtime
