// Checks that stages keep the contract of their kinds in stage.hpp. The checks are the same for foam's own plugins and
// for others.
#pragma once

#include <foam/geometry/solid.hpp>
#include <foam/sdk/registry.hpp>

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] runtime {

/// A promise that a stage broke.
struct ContractFinding {
    std::string stage;
    std::string promise; ///< "keeps the budget"
    std::string message; ///< where it was broken first, and what to do
};

struct ContractOptions {
    /// Files that a loader or reader under test reads; without them only its rejections are checked.
    std::vector<std::filesystem::path> samples{};
    /// Parameters of stages by their names, where the defaults are not enough.
    std::map<std::string, std::map<std::string, ParameterValue>> parameters{};
    /// Called before each promise is checked, so that a crash can be attributed.
    std::function<void(const std::string& stage, const std::string& promise)> on_promise{};
};

/// Runs a stage with its default parameters, or those of the options, on built-in geometry. Never throws for what the
/// stage does; returns the first violation of each promise.
std::vector<ContractFinding> check_contract(const RegisteredStage& stage, const Registry& registry,
                                            const ContractOptions& options = {});

} // namespace runtime
} // namespace foam

/// Geometry for testing stages.
namespace foam {
inline namespace [[gnu::visibility("default")]] runtime {
namespace sample {

/// Returns a box of 12 triangles, wound outwards.
Mesh box(const Vec3& size, const Vec3& center = {});
Mesh torus(double large, double small, std::uint32_t around = 24, std::uint32_t across = 12);
/// Returns an L of 0.2 × 0.1 × 0.15 m, 0.05 m thick.
Mesh bracket();
/// Returns makers of solids of many kinds by name, difficult ones included.
const std::map<std::string, std::function<std::shared_ptr<const Solid>()>>& solids();

} // namespace sample
} // namespace runtime
} // namespace foam
