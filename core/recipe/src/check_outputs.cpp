// outputs and snapshots: the files of a run.
#include "format.hpp"

#include <foam/base/file.hpp>
#include <foam/recipe/internal/check.hpp>
#include <foam/sdk/engines.hpp>
#include <foam/sdk/kinds.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace foam::inline recipe::reading {
namespace {

namespace fs = std::filesystem;

/// Returns why a run cannot write `file`; empty if it can.
std::string why_no_output_file(const std::string& file) {
    static constexpr const char* reserved[] = {"links",        "snapshots",    "report.html", "recipe.resolved.yaml",
                                               "events.jsonl", "manifest.json"};
    const fs::path path(file);
    if (file.empty() || file.back() == '/' || path.filename() == ".") {
        return "names no file";
    }
    if (path.is_absolute()) {
        return "is absolute; remedy: give it relative to the run's folder";
    }
    if (std::find(path.begin(), path.end(), "..") != path.end()) {
        return "leads out of the run's folder; remedy: delete '..'";
    }
    if (std::any_of(file.begin(), file.end(), [](unsigned char c) { return c < 0x20 || c == 0x7F || c == '\\'; })) {
        return "holds a backslash or control character; remedy: separate folders by '/'";
    }
    const std::string top = path.lexically_normal().begin()->string();
    if (std::find(std::begin(reserved), std::end(reserved), top) != std::end(reserved)) {
        return "is a name that every run writes itself; remedy: choose another";
    }
    return file.size() > 1000 ? "is longer than 1000 characters" : "";
}

/// Returns whether both are the same file, or one is a file where the other needs a folder.
bool collide(const std::string& a, const std::string& b) {
    return a == b || a.starts_with(b + "/") || b.starts_with(a + "/");
}

void warn_of_ending(const RegisteredStage& writer, const std::string& file, const Place& where, Findings& findings) {
    const std::string ending = extension_of(file);
    const auto& usual = writer.info.extensions;
    if (!usual.empty() && std::find(usual.begin(), usual.end(), ending) == usual.end()) {
        findings.warning(where, "unusual-ending",
                         fmt::format("{} writes .{}, regardless of the extension of {}", writer.info.name,
                                     fmt::join(usual, " or ."), in_quotes(file)));
    }
}

/// Returns the file of an output; empty after a finding.
std::string output_file(const StageItem& item, const Recipe& recipe, const Checking& checking) {
    const Value* given =
        item.parameters && item.parameters->is(Value::Kind::map) ? item.parameters->find("file") : nullptr;
    const auto& endings = item.stage->info.extensions;
    if (!given && endings.empty()) {
        checking.findings.error(
            item.name.where, "missing-key",
            fmt::format("{} needs 'file'; remedy: write {}: {{file: NAME}}", item.call.stage, item.call.stage));
        return "";
    }
    if (!given) {
        return recipe.name + "." + endings.front();
    }
    const auto read = read_value(*given, Parameter::text("file", ""), item.call.stage, checking.findings);
    if (!read) {
        return "";
    }
    const std::string file = std::get<std::string>(*read);
    if (const std::string why = why_no_output_file(file); !why.empty()) {
        checking.findings.error(given->where, "bad-path", fmt::format("output file {} {}", in_quotes(file), why));
        return "";
    }
    warn_of_ending(*item.stage, file, given->where, checking.findings);
    return fs::path(file).lexically_normal().string();
}

/// Reads the file whose spheres the output replaces.
void read_into(const StageItem& item, OutputCall& output, const Checking& checking) {
    const Value* given =
        item.parameters && item.parameters->is(Value::Kind::map) ? item.parameters->find("into") : nullptr;
    if (!given) {
        return;
    }
    if (const auto read = read_value(*given, Parameter::text("into", ""), item.stage->info.name, checking.findings)) {
        output.into = std::get<std::string>(*read);
        output.into_where = checking.findings.locate(given->where);
    }
}

/// Returns the files of an output: its own, and those that its writer writes beside it.
std::vector<std::string> files_of(const OutputCall& output, const Registry& registry) {
    std::vector<std::string> files{output.file};
    if (const RegisteredStage* writer = registry.find(output.writer.stage)) {
        for (const std::string& ending : writer->info.companions) {
            files.push_back(companion_of(output.file, ending).string());
        }
    }
    return files;
}

/// Returns the first file of `files` that collides with one of `others`, and that one; nothing if none does.
std::optional<std::pair<std::string, std::string>> collision(const std::vector<std::string>& files,
                                                             const std::vector<std::string>& others) {
    for (const std::string& file : files) {
        for (const std::string& other : others) {
            if (collide(file, other)) {
                return std::pair(file, other);
            }
        }
    }
    return {};
}

/// Refuses a writer whose files hold none of the elements that the spherizer makes.
bool holds_elements(const StageItem& writer, const Recipe& recipe, const Checking& checking) {
    const RegisteredStage* spherizer = checking.registry.find(recipe.spherizer.stage);
    const std::vector<Element::Kind>& held = writer.stage->info.kinds;
    if (!spherizer || writer.stage->info.consumer.elements_optional ||
        std::any_of(spherizer->info.kinds.begin(), spherizer->info.kinds.end(),
                    [&](Element::Kind kind) { return knows_all(held, {kind}); })) {
        return true;
    }
    checking.findings.error(writer.name.where, "wrong-kind",
                            fmt::format("files of {} hold {}, {} makes {}; remedy: another output, such as write.json, "
                                        "or another spherizer",
                                        in_quotes(writer.call.stage), words_of(held), in_quotes(recipe.spherizer.stage),
                                        words_of(spherizer->info.kinds)));
    return false;
}

/// Refuses an output for a program that collides with none of the elements that the spherizer makes, or for which
/// spheres inside would grow.
bool suits_engine(const StageItem& item, const Recipe& recipe, const Checking& checking) {
    const auto given = item.call.given.find("engine");
    const RegisteredStage* spherizer = checking.registry.find(recipe.spherizer.stage);
    if (given == item.call.given.end() || std::get<std::string>(given->second) == "any" || !spherizer) {
        return true;
    }
    const Engine& engine = engine_named(std::get<std::string>(given->second));
    std::string why;
    if (engine.stated && recipe.guarantee == Guarantee::inner) {
        why = fmt::format("for {} elements are written larger, which guarantee: inner does not allow; remedy: engine: "
                          "any",
                          engine.title);
    } else if (std::none_of(spherizer->info.kinds.begin(), spherizer->info.kinds.end(),
                            [&](Element::Kind kind) { return knows_all(engine.kinds, {kind}); })) {
        why = fmt::format("foam writes {} for {}, {} makes {}; remedy: another spherizer, or engine: any",
                          words_of(engine.kinds), engine.title, in_quotes(recipe.spherizer.stage),
                          words_of(spherizer->info.kinds));
    }
    if (!why.empty()) {
        checking.findings.error(item.name.where, "conflict", why);
    }
    return why.empty();
}

void add_output(const Value& value, Recipe& recipe, const Checking& checking) {
    StageItem item = read_stage_item(value, "outputs", checking);
    const bool edits = item.stage && item.stage->info.consumer.edits;
    read_stage_parameters(item, edits ? std::vector<std::string>{"file", "into"} : std::vector<std::string>{"file"},
                          checking);
    if (!item.stage) {
        return;
    }
    if (item.stage->kind != StageKind::writer) {
        checking.findings.error(item.name.where, "wrong-kind",
                                fmt::format("{} is a {}, an output needs a writer (write.*)",
                                            in_quotes(item.call.stage), to_string(item.stage->kind)));
        return;
    }
    if (!holds_elements(item, recipe, checking) || !suits_engine(item, recipe, checking)) {
        return;
    }
    const std::string file = output_file(item, recipe, checking);
    if (file.empty()) {
        return;
    }
    OutputCall output{std::move(item.call), file};
    const std::vector<std::string> files = files_of(output, checking.registry);
    if (std::find(files.begin() + 1, files.end(), file) != files.end()) {
        checking.findings.error(item.name.where, "duplicate-file",
                                fmt::format("{} writes other files beside {}, one of them under the same name; remedy: "
                                            "a file that ends in .{}",
                                            output.writer.stage, in_quotes(file), item.stage->info.extensions.front()));
        return;
    }
    for (const OutputCall& other : recipe.outputs) {
        if (const auto both = collision(files, files_of(other, checking.registry))) {
            checking.findings.error(item.name.where, "duplicate-file",
                                    fmt::format("output file {} collides with {} of line {}; remedy: rename one",
                                                in_quotes(both->first), in_quotes(both->second),
                                                other.writer.where.line));
            return;
        }
    }
    read_into(item, output, checking);
    recipe.outputs.push_back(std::move(output));
}

void add_default_outputs(const Value& root, Recipe& recipe, const Checking& checking) {
    const bool robot = recipe.mesh.empty();
    for (const char* kind : {"urdf", "json"}) {
        OutputCall output;
        output.writer.stage = fmt::format("write.{}", kind);
        output.writer.where = checking.findings.locate(root.where);
        output.file = fmt::format("{}.{}", recipe.name, kind);
        const RegisteredStage* stage = checking.registry.find(output.writer.stage);
        if (!robot && output.writer.stage == "write.urdf") {
            continue;
        }
        if (!stage || stage->kind != StageKind::writer) {
            checking.findings.error({root.where.source, 1, 1}, "missing-key",
                                    fmt::format("without 'outputs' a run writes by {}, which no loaded plugin offers; "
                                                "remedy: write outputs: [...], or see `foam plugins --why`",
                                                output.writer.stage));
            continue;
        }
        recipe.outputs.push_back(std::move(output));
    }
}

void read_size(const Value& value, Recipe& recipe, Findings& findings) {
    if (!value.is(Value::Kind::list) || value.items.size() != 2) {
        findings.error(
            value.where, "wrong-type",
            fmt::format("'size' of snapshots expects [width, height], got {}; remedy: write size: [1280, 960]",
                        value.is(Value::Kind::list) ? fmt::format("a list of {}", value.items.size())
                                                    : value.description()));
        return;
    }
    for (std::size_t i = 0; i < 2; ++i) {
        const Parameter pixels = Parameter::integer("size", 1280).bounds(smallest_picture, largest_picture).unit("px");
        if (const auto read = read_value(value.items[i], pixels, "snapshots", findings)) {
            recipe.snapshot_size[i] = static_cast<int>(std::get<std::int64_t>(*read));
        }
    }
}

void read_renderer(const Value& value, Recipe& recipe, const Checking& checking) {
    StageItem item = read_stage_item(value, "renderer", checking);
    read_stage_parameters(item, {}, checking);
    if (item.stage && item.stage->kind != StageKind::renderer) {
        checking.findings.error(item.name.where, "wrong-kind",
                                fmt::format("{} is a {}, 'renderer' needs a renderer", in_quotes(item.call.stage),
                                            to_string(item.stage->kind)));
    }
    recipe.renderer = std::move(item.call);
}

} // namespace

JointValues read_pose(const Value& value, Findings& findings, const std::string& name) {
    JointValues pose;
    if (expect_map(value, name, fmt::format("{}: {{joint: 0.5}}", name), findings)) {
        for (std::size_t i = 0; i < value.keys.size(); ++i) {
            const Parameter joint = Parameter::number(value.keys[i].text, 0);
            if (const auto read = read_value(value.items[i], joint, name, findings)) {
                pose[value.keys[i].text] = std::get<double>(*read);
            }
        }
    }
    return pose;
}

void check_outputs(const Value* outputs, const Value& root, Recipe& recipe, const Checking& checking) {
    if (!outputs) {
        add_default_outputs(root, recipe, checking);
    } else if (expect_list(*outputs, "outputs", "outputs: [write.json: {file: NAME.json}]", checking.findings)) {
        for (const Value& item : outputs->items) {
            add_output(item, recipe, checking);
        }
    }
}

void check_snapshots(const Value* snapshots, const Value& root, Recipe& recipe, const Checking& checking) {
    if (snapshots && snapshots->is(Value::Kind::boolean)) {
        recipe.snapshots = snapshots->flag;
    } else if (snapshots && snapshots->is(Value::Kind::map)) {
        recipe.snapshots = true;
        refuse_unknown_keys(*snapshots, "snapshots", {"size", "pose", "renderer"}, checking.findings);
        if (const Value* size = snapshots->find("size")) {
            read_size(*size, recipe, checking.findings);
        }
        if (const Value* pose = snapshots->find("pose")) {
            recipe.pose = read_pose(*pose, checking.findings);
            recipe.pose_where = checking.findings.locate(pose->where);
        }
        if (const Value* renderer = snapshots->find("renderer")) {
            read_renderer(*renderer, recipe, checking);
            return;
        }
    } else if (snapshots) {
        checking.findings.error(
            snapshots->where, "wrong-type",
            fmt::format("'snapshots' expects true, false or a map, got {}; remedy: write snapshots: "
                        "{{size: [1280, 960]}}",
                        snapshots->description()));
    }
    if (!recipe.snapshots && !recipe.debug_snapshots) {
        return;
    }
    recipe.renderer.stage = default_renderer;
    const char* key = recipe.snapshots ? "snapshots" : "debug";
    const Place where = root.find_key(key)->where;
    recipe.renderer.where = checking.findings.locate(where);
    const RegisteredStage* stage = checking.registry.find(default_renderer);
    if (!stage || stage->kind != StageKind::renderer) {
        checking.findings.error(
            where, "unknown-stage",
            fmt::format("snapshots are drawn by {}, which no loaded plugin offers; remedy: name another "
                        "with snapshots: {{renderer: …}}, or see `foam plugins --why`",
                        default_renderer));
    }
}

} // namespace foam::recipe::reading
