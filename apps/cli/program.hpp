// What all subcommands share: the registry, filled when it is first asked for, and the chosen action.
#pragma once

#include <foam/recipe/recipe.hpp>
#include <foam/runtime/scratch_folder.hpp>
#include <foam/sdk/registry.hpp>

#include <CLI/CLI.hpp>
#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace foam::cli {

/// Arguments that may be `-`. What arrives there goes to a temporary file, which takes the place of the argument.
class StandardInput {
public:
    enum class Holds { geometry, model };

    /// Registers an argument. The format of a robot or a mesh must be recognised or given; a model's reader
    /// recognises it.
    void may_be(std::string& argument, Holds holds);
    void may_be(std::vector<std::string>& arguments, Holds holds);
    /// `--input-format`.
    void add_format(CLI::App& command);
    /// Reads the standard input if an argument is `-`. Throws Error(usage) for two of them, Error(input) for what is
    /// empty, too large or not recognised.
    void take();
    /// Returns whether this argument was `-`.
    bool is(const std::string& argument) const { return !file_.empty() && argument == file_; }
    /// Returns the temporary file; empty if no argument was `-`.
    const std::string& file() const { return file_; }
    /// Returns the name that the content goes by: a file in the current folder, from which relative references lead. It
    /// does not exist. Empty if no argument was `-`.
    const std::filesystem::path& name() const { return name_; }
    /// Returns name() for the argument that was `-`; empty for another.
    std::filesystem::path name_of(const std::string& argument) const {
        return is(argument) ? name_ : std::filesystem::path();
    }

private:
    struct Single {
        std::string* argument;
        Holds holds;
    };
    struct Several {
        std::vector<std::string>* arguments;
        Holds holds;
    };
    void store(std::string& argument, Holds holds);

    std::vector<Single> single_;
    std::vector<Several> several_;
    std::string format_, file_;
    std::filesystem::path name_;
    std::optional<ScratchFolder> folder_;
};

/// Returns the ending of a robot's or a mesh's format that the first bytes of a text of `size` bytes show: urdf, stl,
/// ply, obj, off, dae, glb or gltf; empty for another.
std::string ending_of_content(std::string_view begin, std::uintmax_t size);

/// Returns the argument as messages name it: "stdin" for `-`.
std::string named(const std::string& argument);

/// Reads the recipe; `-` is the standard input, whose paths lead from the current folder.
RecipeResult read_recipe_argument(const std::string& file, Registry& registry, const std::vector<Setting>& settings,
                                  const std::vector<std::string>& variants);

/// This program's file, even if another has taken its place since.
inline constexpr const char* own_program = "/proc/self/exe";

class Program {
public:
    Program();

    CLI::App app;
    /// The command line as the program got it; null-terminated.
    char** arguments = nullptr;
    StandardInput standard_input;
    /// Set by the subcommand that was named; returns the exit code.
    std::function<int()> action;

    /// All plugins loaded. A file given by --plugin that is refused throws Error(plugin); others that are refused are
    /// warned of if `warn`.
    Registry& registry(bool warn = true);
    /// The same, each plugin that does not belong to this installation loaded in a process of its own first: one that
    /// crashes is refused.
    Registry& probed_registry();
    /// Where plugins are looked for.
    std::vector<std::filesystem::path> plugin_folders() const;

private:
    Registry& fill(bool warn);
    std::vector<std::string> plugin_files_, plugin_folders_;
    std::optional<Registry> registry_;
};

/// A subcommand with examples at the end of its help.
CLI::App* add_command(Program& program, const std::string& name, const std::string& summary,
                      const std::string& examples);
/// `--set key.path=value`, repeatable.
void add_settings(CLI::App& command, std::vector<std::string>& texts);
/// `--strict`: a setting of the recipe.
void add_strict(CLI::App& command, std::vector<std::string>& texts);
/// `--variant NAME`, repeatable.
void add_variants(CLI::App& command, std::vector<std::string>& names);
/// `-j`: number of threads.
void add_threads(CLI::App& command, std::size_t& threads);
/// `--package NAME=FOLDER`, repeatable.
void add_packages(CLI::App& command, std::vector<std::string>& texts);
/// Returns them as entries of a package path, absolute. Throws Error(usage) for a text without '='.
std::vector<std::filesystem::path> package_path_of(const std::vector<std::string>& texts);
/// `--unit` and `--scale` of a single mesh.
void add_mesh_unit(CLI::App& command, MeshUnit& unit);
/// A length in m from "10mm"; throws Error(usage) naming the option.
double length_of(const std::string& text, const std::string& option);
/// Throws Error(usage) for a text without '='.
std::vector<Setting> settings_of(const std::vector<std::string>& texts);

/// Writes to stdout all at once, what people read: no text from a file steers their terminal. Throws Error(output) if
/// that fails.
void print(std::string_view text);
/// The same for what programs read: byte by byte.
void print_data(std::string_view bytes);
/// The same for JSON; of what would steer a terminal it holds the escapes.
void print_json(const nlohmann::ordered_json& json);
/// Tells the findings, each on a line of its own.
void tell_findings(const std::vector<Diagnostic>& findings);
/// On stderr, as print(): with the program's name, and a line end.
void tell(std::string_view line);
/// The same without them.
void tell_text(std::string_view text);

/// Returns the commit, the build type and the compiler: "1a2b3c4d5e, Release, g++ 12.2.0"; without the commit where
/// foam was not built in a clone.
std::string build_text();

/// Opens /dev/null in the place of each standard stream that the caller has closed: else the next file that is opened
/// would take its number, and messages would go into it.
void open_closed_streams();

/// Installs a guard: if a stage calls exit(), quick_exit() or _exit(), the program names it, removes the unfinished run
/// directory and ends with the exit code of a plugin's fault. For the whole process; call it once.
void report_ends_by_stages();
/// Removes that guard: the program itself is about to end. Safe in a signal handler.
void expect_end();

/// Reads the command line, runs the command that it names, reports errors, and returns the exit code. A call as the
/// child process of an isolated stage does not return.
int run_main(int count, char** arguments, const std::function<void(Program&)>& add_commands);

} // namespace foam::cli
