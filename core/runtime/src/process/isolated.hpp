// Calls of stages: in this process, or in a child process where the recipe requests it. The results are the same, byte
// for byte.
#pragma once

#include <foam/geometry/internal/own_frame.hpp>
#include <foam/geometry/solid.hpp>
#include <foam/runtime/internal/workspace.hpp>
#include <foam/sdk/stage.hpp>

#include <filesystem>
#include <memory>
#include <span>
#include <vector>

namespace foam::inline runtime {

/// These functions throw what the stage throws. For an isolated stage they also throw Error for a crash, a limit or an
/// early end of its process.
Mesh call_loader(const Calls& calls, const StageCall& call, const std::filesystem::path& file, Context& context);
/// Calls a filter with the mesh in a normalised frame.
Mesh call_filter(const Workspace& workspace, const StageCall& call, const Mesh& mesh, Context& context);
/// A stage and its search for one shape.
struct StartedSearch {
    std::unique_ptr<Spherizer> stage;
    std::unique_ptr<SphereSearch> search;
};

/// Calls a spherizer. `started`: filled by the first call, unless the stage is isolated; further calls continue it.
/// `shape`: in `frame`, from which the trees are transformed back. The call and the budgets are in metres.
std::vector<SphereTree> call_spherizer(const Workspace& workspace, const StageCall& call, StartedSearch& started,
                                       const Shape& shape, const geometry::OwnFrame& frame,
                                       std::span<const Budget> budgets, Context& context);

/// Adds a stage's isolation to a hash, for tasks that are shared only if they run alike. Not part of a cache key.
void add_isolation(Hasher& hasher, const Isolation& isolation);

} // namespace foam::runtime
