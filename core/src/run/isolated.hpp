// Calls of stages: here, or in a child process where the recipe says so. The results are the same, byte for byte.
#pragma once

#include "workspace.hpp"

#include "geometry/own_frame.hpp"

#include <foam/solid.hpp>
#include <foam/stage.hpp>

#include <filesystem>
#include <memory>
#include <span>
#include <vector>

namespace foam {

/// Throw what the stage throws; of an isolated one also Error for a crash, a limit or an early end of its process.
Mesh call_loader(const Workspace& workspace, const std::string& stage, const std::filesystem::path& file,
                 Context& context);
/// The stage sees the mesh in a frame of its own.
Mesh call_filter(const Workspace& workspace, const StageCall& call, const Mesh& mesh, Context& context);
/// `stage`: made at the first call, for the next ones with the same shape: a stage may go on where it was. `shape`: in
/// `frame`, from which the trees come back; the call and the budgets are in metres.
std::vector<SphereTree> call_spherizer(const Workspace& workspace, const StageCall& call,
                                       std::unique_ptr<Spherizer>& stage, const Shape& shape,
                                       const geometry::OwnFrame& frame, std::span<const Budget> budgets,
                                       Context& context);

/// Adds how a stage is isolated, for tasks that are one only if they run alike. No part of a cache key.
void add_isolation(Hasher& hasher, const Isolation& isolation);

} // namespace foam
