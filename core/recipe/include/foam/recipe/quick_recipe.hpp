// The recipe that `foam spherize` stands for.
#pragma once

#include <foam/recipe/mesh_unit.hpp>
#include <foam/recipe/robot_choices.hpp>
#include <foam/sdk/registry.hpp>

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] recipe {

/// A length that a user gave.
struct QuickLength {
    double metres = 0;
    bool has_unit = false; ///< "10mm", not 0.01

    QuickLength(double in_metres, bool with_unit = false) : metres(in_metres), has_unit(with_unit) {}
};

/// What 'budget' says; nothing: the spherizer's own parameters rule.
struct QuickBudget {
    std::optional<std::size_t> spheres;
    std::optional<double> excess;
    std::optional<QuickLength> max_protrusion;
    std::optional<double> cost{};          ///< of checking all elements
    std::map<std::string, double> costs{}; ///< by the words of `costs`
    std::optional<QuickLength> pad{};      ///< added to all radii
};

/// The stage that makes the elements.
struct QuickMethod {
    /// A spherizer, with or without "spherize."; for elements of any kind "approximate.", empty: the one for the kinds.
    std::string stage;
    bool elements = false; ///< of any kind, as `foam approximate`
    std::vector<Element::Kind> kinds{};
    std::string objective{}; ///< empty: that of the stage

    QuickMethod(std::string spherizer) : stage(std::move(spherizer)) {}
    QuickMethod(std::string approximator, std::vector<Element::Kind> of, std::string aim)
        : stage(std::move(approximator)), elements(true), kinds(std::move(of)), objective(std::move(aim)) {}
};

struct QuickRecipe {
    std::string name;
    std::string text;                  ///< YAML
    std::string stage;                 ///< that makes the spheres or elements
    std::string output;                ///< the file it writes, relative to the run directory
    std::vector<std::string> left_out; ///< stages of the usual chain that no plugin offers
};

/// `input`: a mesh or a URDF; `ending`: of the output's name, for which there must be a writer. `unit`: of a mesh.
/// `geometry`: the word of `cover`. `choices`: of the robot; the names in it are checked by require_choices(). Throws
/// Error(usage) for what is not known, and for choices of a mesh.
QuickRecipe quick_recipe(const std::filesystem::path& input, const QuickMethod& method, const std::string& ending,
                         const QuickBudget& budget, const MeshUnit& unit, const std::string& geometry,
                         const Registry& registry, const RobotChoices& choices = {});

/// Returns the writer of a format: "curobo" is write.curobo; otherwise the only one whose files have that ending.
/// Throws Error(usage) if there is none, or several.
const RegisteredStage& writer_for(const std::string& format, const Registry& registry);

/// Throws Error(usage) if a file of this format names the input, which is `-` and has no name: "recipe", and formats
/// that refer to meshes if the input is one.
void refuse_naming(const std::string& format, const std::filesystem::path& input, const Registry& registry);

/// Whether the registry can load it as a mesh; otherwise it is taken for a robot. Throws Error(usage) if it is neither.
bool is_mesh(const std::filesystem::path& input, const Registry& registry);

/// Returns the format in which a robot is written back, "mjcf" for an MJCF: that of its file, whose content decides; "urdf"
/// where foam does not write that format. Throws Error(input) for a file that cannot be read.
std::string own_format(const std::filesystem::path& input, const Registry& registry);

} // namespace recipe
} // namespace foam
