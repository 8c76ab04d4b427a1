// The recipe that `foam spherize` stands for.
#pragma once

#include <foam/recipe/mesh_unit.hpp>
#include <foam/sdk/registry.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] recipe {

/// What 'budget' says; nothing: the spherizer's own parameters rule.
struct QuickBudget {
    std::optional<std::size_t> spheres;
    std::optional<double> excess, max_protrusion; ///< max_protrusion: m
};

struct QuickRecipe {
    std::string name;
    std::string text;                  ///< YAML
    std::string output;                ///< the file it writes, relative to the run directory
    std::vector<std::string> left_out; ///< stages of the usual chain that no plugin offers
};

/// `input`: a mesh or a URDF; `method`: a spherizer, with or without "spherize."; `ending`: of the output's name, for
/// which there must be a writer. `unit`: of a mesh. `geometry`: the word of `cover`. Throws Error(usage) for what is
/// not known.
QuickRecipe quick_recipe(const std::filesystem::path& input, const std::string& method, const std::string& ending,
                         const QuickBudget& budget, const MeshUnit& unit, const std::string& geometry,
                         const Registry& registry);

/// Returns the writer of a format: "curobo" is write.curobo; otherwise the only one whose files have that ending.
/// Throws Error(usage) if there is none, or several.
const RegisteredStage& writer_for(const std::string& format, const Registry& registry);

/// Whether the registry can load it as a mesh; otherwise it is taken for a robot. Throws Error(usage) if it is neither.
bool is_mesh(const std::filesystem::path& input, const Registry& registry);

} // namespace recipe
} // namespace foam
