#include "plugin_file.hpp"

#include <foam/base/error.hpp>
#include <foam/base/internal/activity.hpp>
#include <foam/base/text.hpp>
#include <foam/sdk/internal/declaration.hpp>
#include <foam/sdk/registry.hpp>

#include <fmt/format.h>

#include <dlfcn.h>
#include <sys/stat.h>

#include <algorithm>
#include <cctype>
#include <cfenv>
#include <new>

namespace foam::inline sdk {
namespace {

namespace fs = std::filesystem;

class Collector final : public Enrolment {
public:
    void add_stage(StageKind kind, StageInfo info, StageFactory factory) override {
        stages.push_back({kind, std::move(info), std::move(factory), "", "", "", ""});
    }
    std::vector<RegisteredStage> stages;
};

bool is_of_kind(const Stage& stage, StageKind kind) {
    switch (kind) {
    case StageKind::mesh_loader:
        return dynamic_cast<const MeshLoader*>(&stage) != nullptr;
    case StageKind::robot_loader:
        return dynamic_cast<const RobotLoader*>(&stage) != nullptr;
    case StageKind::mesh_filter:
        return dynamic_cast<const MeshFilter*>(&stage) != nullptr;
    case StageKind::spherizer:
        return dynamic_cast<const Spherizer*>(&stage) != nullptr;
    case StageKind::renderer:
        return dynamic_cast<const Renderer*>(&stage) != nullptr;
    case StageKind::writer:
        return dynamic_cast<const Writer*>(&stage) != nullptr;
    case StageKind::model_reader:
        return dynamic_cast<const ModelReader*>(&stage) != nullptr;
    case StageKind::refiner:
        return dynamic_cast<const Refiner*>(&stage) != nullptr;
    }
    return false;
}

std::string writable_by_others(const fs::path& file) {
    struct stat status {};
    if (stat(file.c_str(), &status) != 0) {
        return "there is no such file; remedy: check the path";
    }
    if (!S_ISREG(status.st_mode)) {
        return "it is not a regular file; remedy: give the file of the plugin itself";
    }
    if (status.st_mode & S_IWOTH) {
        return fmt::format("everybody may write to it, so anybody's code could run; remedy: chmod o-w {}",
                           file.string());
    }
    // Where the sticky bit is set, as in /tmp, only its owner may replace a file.
    const fs::path folder = fs::absolute(file).parent_path();
    if (stat(folder.c_str(), &status) == 0 && (status.st_mode & S_IWOTH) && !(status.st_mode & S_ISVTX)) {
        return fmt::format("everybody may replace it in its folder, so anybody's code could run; remedy: chmod o-w {}",
                           folder.string());
    }
    return "";
}

using Entry = const foam_plugin_envelope_v1* (*)();

/// Runs a plugin's code for the first time: writes its metadata to the record and its stages to the collector. Returns
/// why it failed; empty if it succeeded.
std::string enrol(Entry entry, PluginRecord& record, Collector& collector) {
    try {
        const foam_plugin_envelope_v1* envelope = entry();
        if (const std::string why = why_bad(envelope); !why.empty()) {
            return why;
        }
        record.name = envelope->name;
        record.version = envelope->version;
        record.license = envelope->license;
        envelope->enrol(collector);
    } catch (const std::exception& error) {
        return fmt::format("it threw while it enrolled its stages: {}; remedy: correct the body of FOAM_PLUGIN",
                           error.what());
    } catch (...) {
        return "it threw an object that is not a std::exception while it enrolled its stages; remedy: correct the body "
               "of FOAM_PLUGIN";
    }
    return "";
}

/// Restores rounding and the treatment of small numbers. g++ links code into libraries made with -ffast-math that makes
/// the processor flush small numbers to zero from then on, in all computations of the thread and its children.
class SameArithmetic {
public:
    SameArithmetic() { std::fegetenv(&environment_); }
    ~SameArithmetic() { std::fesetenv(&environment_); }
    SameArithmetic(const SameArithmetic&) = delete;
    SameArithmetic& operator=(const SameArithmetic&) = delete;

private:
    std::fenv_t environment_{};
};

} // namespace

Registry::Registry() = default;
Registry::~Registry() = default;

const PluginRecord& Registry::load(const fs::path& file) {
    std::error_code ignored;
    fs::path canonical = fs::weakly_canonical(file, ignored);
    if (canonical.empty()) {
        canonical = file;
    }
    const auto known =
        std::find_if(plugins_.begin(), plugins_.end(), [&](const PluginRecord& r) { return r.file == canonical; });
    if (known != plugins_.end()) {
        return *known;
    }
    PluginRecord record;
    record.file = canonical;
    record.rejection = try_load(canonical, record);
    plugins_.push_back(std::move(record));
    return plugins_.back();
}

std::string Registry::try_load(const fs::path& file, PluginRecord& record) {
    const SameArithmetic guard;
    if (const std::string why = writable_by_others(file); !why.empty()) {
        return why;
    }
    const ElfNote note = read_foam_note(file);
    if (!note.problem.empty()) {
        return note.problem;
    }
    if (!note.fingerprint) {
        return "it is a shared library, but no foam plugin (there is no FOAM_PLUGIN in it); remedy: take it out of the "
               "folder of plugins, or add FOAM_PLUGIN";
    }
    if (*note.fingerprint != FOAM_ABI_FINGERPRINT) {
        return other_build(*note.fingerprint);
    }
    if (guard_) {
        if (const std::string why = guard_(file); !why.empty()) {
            return why;
        }
    }
    const ActivityScope activity(fmt::format("plugin {}, while it was loaded", file.string()),
                                 CrashRemedy::remove_plugin);
    // Never closed: its code may still be in use by stage objects, exceptions and type information.
    void* handle = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
    if (!handle) {
        return fmt::format(
            "the system cannot load it: {}; remedy: link the plugin with all that it uses, and rebuild it "
            "against this foam",
            dlerror());
    }
    const auto entry = reinterpret_cast<Entry>(dlsym(handle, "foam_plugin_v1"));
    if (!entry) {
        return "it has no entry point foam_plugin_v1; remedy: use the FOAM_PLUGIN macro";
    }
    Collector collector;
    if (const std::string why = enrol(entry, record, collector); !why.empty()) {
        return why;
    }
    if (const std::string why = why_bad(collector.stages, *this); !why.empty()) {
        return why;
    }
    const std::string build = build_identity(note.build_id, file);
    for (RegisteredStage& stage : collector.stages) {
        stage.plugin = record.name;
        stage.plugin_version = record.version;
        stage.license = record.license;
        stage.build = build;
        record.stages.push_back(stage.info.name);
        stages_.emplace(stage.info.name, std::move(stage));
    }
    return "";
}

void Registry::load_directory(const fs::path& directory) {
    std::vector<fs::path> files;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(directory, error)) {
        if (entry.path().extension() == ".so") {
            files.push_back(entry.path());
        }
    }
    std::sort(files.begin(), files.end());
    for (const fs::path& file : files) {
        load(file);
    }
}

const RegisteredStage* Registry::find(std::string_view stage) const {
    const auto it = stages_.find(stage);
    return it == stages_.end() ? nullptr : &it->second;
}

std::vector<const RegisteredStage*> Registry::robot_loaders_of(std::string_view text) const {
    std::vector<const RegisteredStage*> loaders;
    for (const auto& [name, stage] : stages_) {
        if (stage.kind == StageKind::robot_loader && make<RobotLoader>(name)->recognises(text)) {
            loaders.push_back(&stage);
        }
    }
    return loaders;
}

const RegisteredStage* Registry::find_for_extension(StageKind kind, std::string_view extension,
                                                    std::string_view preferred) const {
    const std::string wanted = lower_case(extension);
    const RegisteredStage* found = nullptr;
    for (const auto& [name, stage] : stages_) {
        const auto& handled = stage.info.extensions;
        if (stage.kind != kind || std::find(handled.begin(), handled.end(), wanted) == handled.end()) {
            continue;
        }
        if (name == preferred) {
            return &stage;
        }
        if (!found || (found->info.last_resort && !stage.info.last_resort)) {
            found = &stage;
        }
    }
    return found;
}

std::string Registry::nearest(std::string_view stage) const {
    const auto method_of = [](std::string_view name) { return std::string(name.substr(name.find('.') + 1)); };
    std::vector<std::string> names, methods;
    for (const auto& [name, unused] : stages_) {
        names.push_back(name);
        methods.push_back(method_of(name));
    }
    if (const std::string near = nearest_word(stage, names); !near.empty()) {
        return near;
    }
    // Without its kind, or with another one: "watertight", "mesh.watertight".
    const auto method = std::find(methods.begin(), methods.end(), nearest_word(method_of(stage), methods));
    return method == methods.end() ? "" : names[static_cast<std::size_t>(method - methods.begin())];
}

/// Makes for a stage the other stages that it declares to use.
class Registry::Maker final : public StageMaker {
public:
    Maker(const Registry& registry, const StageInfo& user) : registry_(registry), user_(user) {}

private:
    std::unique_ptr<Stage> make_stage(std::string_view stage, StageKind kind,
                                      const std::map<std::string, ParameterValue>& parameters) const override {
        if (std::find(user_.uses.begin(), user_.uses.end(), stage) == user_.uses.end()) {
            throw Error(
                ErrorCode::plugin,
                fmt::format("it asks for stage '{}' without naming it; remedy: add it to StageInfo::uses", stage));
        }
        const RegisteredStage* found = registry_.find(stage);
        if (found && !found->info.uses.empty()) {
            throw Error(ErrorCode::plugin,
                        fmt::format("it uses stage '{}', which is made of others itself; remedy: use those", stage));
        }
        return found ? registry_.make_stage(stage, kind, parameters) : nullptr;
    }

    const Registry& registry_;
    const StageInfo& user_;
};

std::unique_ptr<Stage> Registry::make_stage(std::string_view name, StageKind kind,
                                            const std::map<std::string, ParameterValue>& given) const {
    const RegisteredStage* stage = find(name);
    if (!stage) {
        const std::string near = nearest(name);
        throw Error(ErrorCode::usage, fmt::format("unknown stage '{}'{}", name,
                                                  near.empty() ? "; `foam stages` lists them"
                                                               : fmt::format("; did you mean '{}'?", near)));
    }
    if (stage->kind != kind) {
        throw Error(ErrorCode::usage, fmt::format("stage '{}' is a {}, a {} is needed here", name,
                                                  to_string(stage->kind), to_string(kind)));
    }
    try {
        std::unique_ptr<Stage> object =
            stage->factory(Parameters(stage->info.parameters, given), Maker(*this, stage->info));
        if (!object || !is_of_kind(*object, kind)) {
            throw Error(ErrorCode::plugin, fmt::format("plugin {} made no {} for it; remedy: correct the plugin",
                                                       stage->plugin, to_string(kind)));
        }
        return object;
    } catch (const Error& error) {
        throw Error(error.code(), fmt::format("{}: {}", name, error.what()));
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& error) {
        throw Error(ErrorCode::plugin, fmt::format("{}: its constructor threw an exception: {}", name, error.what()));
    } catch (...) {
        throw Error(ErrorCode::plugin,
                    fmt::format("{}: its constructor threw an object that is not a std::exception", name));
    }
}

} // namespace foam::sdk
