// The standard input in the place of a file: `-`.
#pragma once

#include <foam/recipe/recipe.hpp>
#include <foam/runtime/scratch_folder.hpp>

#include <CLI/CLI.hpp>

#include <filesystem>
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

} // namespace foam::cli
