// What all subcommands share: the registry, filled when it is first asked for, and the chosen action.
#pragma once

#include "standard_input.hpp"

#include <foam/recipe/recipe.hpp>
#include <foam/sdk/registry.hpp>

#include <CLI/CLI.hpp>
#include <nlohmann/json_fwd.hpp>

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace foam::cli {

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

} // namespace foam::cli
