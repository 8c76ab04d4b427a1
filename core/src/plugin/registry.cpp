#include <foam/error.hpp>
#include <foam/host/registry.hpp>
#include <foam/text.hpp>

#include "elf_note.hpp"

#include "data/activity.hpp"

#include <fmt/format.h>

#include <dlfcn.h>
#include <sys/stat.h>

#include <algorithm>
#include <cctype>
#include <cfenv>
#include <new>
#include <regex>
#include <set>

namespace foam {
namespace {

namespace fs = std::filesystem;

/// Keys that recipes need for themselves beside a stage's parameters.
std::string why_reserved(const RegisteredStage& stage, std::string_view name) {
    if (stage.kind == StageKind::writer && name == "file") {
        return fmt::format("stage '{}': a writer cannot have a parameter 'file', recipes say by that key where it "
                           "writes; remedy: rename it",
                           stage.info.name);
    }
    const bool isolable = stage.kind == StageKind::mesh_filter || stage.kind == StageKind::spherizer;
    if (isolable && (name == "isolate" || name == "time_limit" || name == "memory_limit")) {
        return fmt::format("stage '{}': a {} cannot have a parameter '{}', recipes say by that key how it is isolated; "
                           "remedy: rename it",
                           stage.info.name, to_string(stage.kind), name);
    }
    return "";
}

/// Why a stage's name does not fit its kind: people read the kind off the name. Empty if it does.
std::string why_misnamed(const RegisteredStage& stage) {
    static constexpr std::pair<StageKind, std::string_view> beginnings[] = {{StageKind::mesh_loader, "load."},
                                                                            {StageKind::robot_loader, "load."},
                                                                            {StageKind::spherizer, "spherize."},
                                                                            {StageKind::renderer, "snapshot."},
                                                                            {StageKind::writer, "write."}};
    const std::string& name = stage.info.name;
    std::string_view fits, taken;
    for (const auto& [kind, beginning] : beginnings) {
        fits = kind == stage.kind ? beginning : fits;
        taken = name.starts_with(beginning) ? beginning : taken;
    }
    if (fits == taken) {
        return "";
    }
    return fits.empty()
               ? fmt::format("stage '{}' is enrolled as a {}, whose name cannot begin with '{}'; remedy: rename "
                             "it, or enrol it as what it is",
                             name, to_string(stage.kind), taken)
               : fmt::format("stage '{}' is enrolled as a {}, whose name begins with '{}'; remedy: rename it, "
                             "or enrol it as what it is",
                             name, to_string(stage.kind), fits);
}

/// Why a stage's objective_parameter is not one of its choices; empty if it is, or there is none.
std::string why_no_objective(const StageInfo& info) {
    const std::string& name = info.objective_parameter;
    const bool found = std::any_of(info.parameters.begin(), info.parameters.end(), [&](const Parameter& p) {
        return p.name == name && p.type == Parameter::Type::choice;
    });
    return name.empty() || found
               ? ""
               : fmt::format("stage '{}': objective_parameter '{}' is no choice among its parameters; "
                             "remedy: declare it by Parameter::choice(…)",
                             info.name, name);
}

/// What a stage declaration gets wrong; empty if nothing.
std::string why_bad(const RegisteredStage& stage) {
    const StageInfo& info = stage.info;
    static const std::regex stage_name("[a-z][a-z0-9]*\\.[a-z][a-z0-9_]*");
    if (!std::regex_match(info.name, stage_name)) {
        return fmt::format(
            "stage name '{}' is not of the form kind.method in lower case, e.g. spherize.mine; remedy: rename it",
            info.name);
    }
    if (const std::string why = why_misnamed(stage); !why.empty()) {
        return why;
    }
    if (info.summary.empty()) {
        return fmt::format("stage '{}' has no summary; remedy: say in one sentence what it does", info.name);
    }
    if (!stage.factory) {
        return fmt::format("stage '{}' has no factory; remedy: enrol it with enrol.add<…>()", info.name);
    }
    static const std::regex parameter_name("[A-Za-z][A-Za-z0-9_]*");
    std::set<std::string> names;
    for (const Parameter& p : info.parameters) {
        if (const std::string why = why_reserved(stage, p.name); !why.empty()) {
            return why;
        }
        if (p.name.empty() || !names.insert(p.name).second) {
            return fmt::format("stage '{}' declares parameter '{}' twice or without a name; remedy: rename it",
                               info.name, p.name);
        }
        if (!std::regex_match(p.name, parameter_name)) {
            return fmt::format("stage '{}': the name of parameter '{}' is not a word of letters, digits "
                               "and _; remedy: rename it",
                               info.name, p.name);
        }
        if (p.doc_text.empty()) {
            return fmt::format("stage '{}': parameter '{}' has no doc sentence; remedy: call .doc(…)", info.name,
                               p.name);
        }
        if (const std::string why = why_invalid(p, p.default_value); !why.empty()) {
            return fmt::format("stage '{}': the default of parameter '{}' breaks its own declaration: {}; remedy: "
                               "correct the one or the other",
                               info.name, p.name, why);
        }
    }
    return why_no_objective(info);
}

/// The fields of a fingerprint in the words of people.
std::map<std::string, std::string> fields_of(std::string_view fingerprint) {
    static constexpr std::pair<std::string_view, std::string_view> names[] = {
        {"foam-abi", "ABI epoch"}, {"cxx11", "std::string ABI (cxx11)"}, {"stdlib", "standard library"}};
    std::map<std::string, std::string> fields;
    for (const std::string_view word : words(fingerprint)) {
        const std::size_t equals = word.find('=');
        std::string name(word.substr(0, equals));
        for (const auto& [short_name, long_name] : names) {
            name = name == short_name ? long_name : name;
        }
        fields[name] = equals == word.npos ? "on" : std::string(word.substr(equals + 1));
    }
    return fields;
}

std::string other_build(std::string_view has) {
    const auto theirs = fields_of(has), ours = fields_of(FOAM_ABI_FINGERPRINT);
    std::vector<std::string> built_for, is;
    for (const auto& [name, value] : ours) {
        const auto other = theirs.find(name);
        if (other != theirs.end() && other->second != value) {
            built_for.push_back(fmt::format("{} {}", name, other->second));
            is.push_back(fmt::format("{} {}", name, value));
        }
    }
    if (is.empty()) { // a field more or less: no release of foam has written that
        built_for.push_back(fmt::format("[{}]", has));
        is.push_back(fmt::format("[{}]", FOAM_ABI_FINGERPRINT));
    }
    return fmt::format("it was built for {}, this foam has {}; remedy: rebuild the plugin against this foam, with the "
                       "same compiler options",
                       fmt::join(built_for, " and "), fmt::join(is, " and "));
}

/// An SPDX licence expression, as far as its form goes: "Apache-2.0", "(MIT OR LicenseRef-Mine) AND BSD-3-Clause".
bool is_license(const std::string& text) {
    static const std::regex form(
        "\\(*[A-Za-z0-9][A-Za-z0-9.+:-]*\\)*( (AND|OR|WITH) \\(*[A-Za-z0-9][A-Za-z0-9.+:-]*\\)*)*");
    return std::regex_match(text, form);
}

/// What an envelope gets wrong; empty if nothing. The fields behind size and epoch are looked at only if those are
/// right.
std::string why_bad(const foam_plugin_envelope_v1* envelope) {
    if (!envelope) {
        return "its entry point returns no envelope; remedy: use the FOAM_PLUGIN macro";
    }
    if (envelope->size != sizeof(foam_plugin_envelope_v1) || envelope->epoch != FOAM_ABI_EPOCH) {
        return fmt::format(
            "its envelope has {} bytes of ABI epoch {}, this foam's has {} of epoch {}; remedy: rebuild the "
            "plugin against this foam",
            envelope->size, envelope->epoch, sizeof(foam_plugin_envelope_v1), FOAM_ABI_EPOCH);
    }
    if (!envelope->fingerprint || std::string_view(envelope->fingerprint) != FOAM_ABI_FINGERPRINT) {
        return other_build(envelope->fingerprint ? envelope->fingerprint : "nothing");
    }
    for (const char* text : {envelope->name, envelope->version, envelope->license}) {
        if (!text || !*text) {
            return "its name, version or license is empty; remedy: state all three in FOAM_PLUGIN";
        }
    }
    if (!is_license(envelope->license)) {
        return fmt::format("its license '{}' is no SPDX expression; remedy: write an identifier of "
                           "spdx.org/licenses, e.g. Apache-2.0, or LicenseRef-NAME for one of your own",
                           envelope->license);
    }
    return envelope->enrol ? "" : "it has no function that enrols stages; remedy: use the FOAM_PLUGIN macro";
}

class Collector final : public Enrolment {
public:
    void add_stage(StageKind kind, StageInfo info, StageFactory factory) override {
        stages.push_back({kind, std::move(info), std::move(factory), "", "", ""});
    }
    std::vector<RegisteredStage> stages;
};

/// What the stages of a plugin get wrong, beside those that are known already; empty if nothing.
std::string why_bad(const std::vector<RegisteredStage>& stages, const Registry& registry) {
    if (stages.empty()) {
        return "it enrols no stage; remedy: call enrol.add<…>() in the body of FOAM_PLUGIN";
    }
    std::set<std::string> names;
    for (const RegisteredStage& stage : stages) {
        if (const std::string why = why_bad(stage); !why.empty()) {
            return why;
        }
        if (const RegisteredStage* other = registry.find(stage.info.name)) {
            return fmt::format(
                "stage '{}' exists already, from plugin {}; remedy: give it another name, or load only one of "
                "the two",
                stage.info.name, other->plugin);
        }
        if (!names.insert(stage.info.name).second) {
            return fmt::format("it enrols stage '{}' twice; remedy: give one another name", stage.info.name);
        }
    }
    return "";
}

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
    return "";
}

std::string lower(std::string_view text) {
    std::string result(text);
    std::transform(result.begin(), result.end(), result.begin(),
                   [](unsigned char c) { return static_cast<char>(c >= 'A' && c <= 'Z' ? c + 32 : c); });
    return result;
}

/// Puts rounding and the treatment of small numbers back: g++ links code into libraries made with -ffast-math that has
/// the processor flush them to zero from then on, in all that the thread and its children compute.
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
    // Never closed again: its code may live on in stage objects, exceptions and type information.
    void* handle = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
    if (!handle) {
        return fmt::format(
            "the system cannot load it: {}; remedy: link the plugin with all that it uses, and rebuild it "
            "against this foam",
            dlerror());
    }
    using Entry = const foam_plugin_envelope_v1* (*)();
    const auto entry = reinterpret_cast<Entry>(dlsym(handle, "foam_plugin_v1"));
    if (!entry) {
        return "it has no entry point foam_plugin_v1; remedy: use the FOAM_PLUGIN macro";
    }
    Collector collector;
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
        return "it threw something that is no std::exception while it enrolled its stages; remedy: correct the body of "
               "FOAM_PLUGIN";
    }
    if (const std::string why = why_bad(collector.stages, *this); !why.empty()) {
        return why;
    }
    for (RegisteredStage& stage : collector.stages) {
        stage.plugin = record.name;
        stage.plugin_version = record.version;
        stage.license = record.license;
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

const RegisteredStage* Registry::find_for_extension(StageKind kind, std::string_view extension) const {
    const std::string wanted = lower(extension);
    for (const auto& [name, stage] : stages_) {
        const auto& handled = stage.info.extensions;
        if (stage.kind == kind && std::find(handled.begin(), handled.end(), wanted) != handled.end()) {
            return &stage;
        }
    }
    return nullptr;
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
    // Without its kind, or with another: "watertight", "mesh.watertight".
    const auto method = std::find(methods.begin(), methods.end(), nearest_word(method_of(stage), methods));
    return method == methods.end() ? "" : names[static_cast<std::size_t>(method - methods.begin())];
}

/// Hands a stage what it says that it uses.
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
        throw Error(ErrorCode::plugin,
                    fmt::format("{}: its constructor failed with an exception of its own: {}", name, error.what()));
    } catch (...) {
        throw Error(ErrorCode::plugin,
                    fmt::format("{}: its constructor threw something that is no std::exception", name));
    }
}

} // namespace foam
