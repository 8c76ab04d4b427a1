// The stages that a program knows, and their plugins. The application owns this object: no globals.
#pragma once

#include <foam/sdk/plugin.hpp>

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] sdk {

/// A plugin file that was examined, loaded or not.
struct PluginRecord {
    std::filesystem::path file;
    std::string name, version, license; ///< empty if loading failed before they were known
    std::vector<std::string> stages;
    std::string rejection; ///< empty if loaded; else why not, and what to do
    bool loaded() const { return rejection.empty(); }
};

/// A stage that can be made.
struct RegisteredStage {
    StageKind kind;
    StageInfo info;
    StageFactory factory;
    std::string plugin, plugin_version, license;
    std::string build; ///< identity of the plugin's build: another build may give other results
};

class Registry {
public:
    Registry();
    ~Registry();
    Registry(const Registry&) = delete;
    Registry& operator=(const Registry&) = delete;

    /// Loads one plugin: all its stages or none. Never throws for a bad plugin: the record has the reason. A loaded
    /// file is not loaded again. The record stays valid until the next load.
    const PluginRecord& load(const std::filesystem::path& file);
    /// Called before a plugin's code runs for the first time. Returns why it must not run; empty if it may.
    using Guard = std::function<std::string(const std::filesystem::path& file)>;
    void set_guard(Guard guard) { guard_ = std::move(guard); }

    /// Loads every *.so of a folder, in the order of their names; skips a folder that does not exist.
    void load_directory(const std::filesystem::path& directory);
    const std::vector<PluginRecord>& plugins() const { return plugins_; }

    /// Returns the stage; nullptr if no stage has that name.
    const RegisteredStage* find(std::string_view stage) const;
    /// Returns all stages by name.
    const std::map<std::string, RegisteredStage, std::less<>>& stages() const { return stages_; }
    /// Returns the loaders that recognise the text of a robot's file, by name.
    std::vector<const RegisteredStage*> robot_loaders_of(std::string_view text) const;
    /// Returns the stage of that kind which handles a file name ending ("stl"; any case); nullptr if none does. Among
    /// several, `preferred` comes first, then the others by name, with those of last resort at the end.
    const RegisteredStage* find_for_extension(StageKind kind, std::string_view extension,
                                              std::string_view preferred = {}) const;
    /// Returns the nearest known stage name, for "did you mean"; empty if none is near.
    std::string nearest(std::string_view stage) const;

    /// Returns a stage object of type T. Throws Error(usage) for an unknown name, another kind or bad parameters.
    template <std::derived_from<Stage> T>
    std::unique_ptr<T> make(std::string_view stage,
                            const std::map<std::string, ParameterValue>& parameters = {}) const {
        return std::unique_ptr<T>(static_cast<T*>(make_stage(stage, T::kind, parameters).release()));
    }

private:
    class Maker;
    std::unique_ptr<Stage> make_stage(std::string_view stage, StageKind kind,
                                      const std::map<std::string, ParameterValue>& parameters) const;
    std::string try_load(const std::filesystem::path& file, PluginRecord& record);

    Guard guard_;
    std::vector<PluginRecord> plugins_;
    std::map<std::string, RegisteredStage, std::less<>> stages_;
};

/// Returns the identity of the builds of foam's libraries that the results of stages depend on: their names and build
/// IDs.
std::string build_of_libraries();

/// Returns the folders that are searched for plugins, in order: `extra`, FOAM_PLUGIN_PATH, the folder that belongs to
/// this installation. Never the current directory.
std::vector<std::filesystem::path> plugin_directories(const std::vector<std::filesystem::path>& extra = {});

} // namespace sdk
} // namespace foam
