// Holds stages to what their kinds promise in stage.hpp: the same checks for foam's own plugins and for those of
// others.
#pragma once

#include <foam/host/registry.hpp>
#include <foam/solid.hpp>

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace foam {

/// A promise that a stage broke.
struct ContractFinding {
    std::string stage;
    std::string promise; ///< "keeps the budget"
    std::string message; ///< where it was broken first, and what to do
};

struct ContractOptions {
    /// Files that a loader under test reads; without them only its refusals are looked at.
    std::vector<std::filesystem::path> samples;
    /// Told of every promise before it is looked at, so that a crash has a name.
    std::function<void(const std::string& stage, const std::string& promise)> on_promise;
};

/// Runs a stage with its default parameters on built-in geometry. Never throws for what the stage does; the first
/// breach of each promise is reported.
std::vector<ContractFinding> check_contract(const RegisteredStage& stage, const Registry& registry,
                                            const ContractOptions& options = {});

} // namespace foam

/// Geometry to try stages on.
namespace foam::sample {

/// 12 triangles, outward.
Mesh box(const Vec3& size, const Vec3& center = {});
Mesh torus(double large, double small, std::uint32_t around = 24, std::uint32_t across = 12);
/// An L of 0.2 × 0.1 × 0.15 m, 0.05 m thick.
Mesh bracket();
/// Makers of solids of many kinds by name, the awkward ones among them.
const std::map<std::string, std::function<std::shared_ptr<const Solid>()>>& solids();

} // namespace foam::sample
