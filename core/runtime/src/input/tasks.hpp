// Tasks of the preparation: they run in parallel, and errors stay with them.
#pragma once

#include <foam/base/error.hpp>
#include <foam/base/parallel.hpp>
#include <foam/geometry/mesh.hpp>

#include <vector>

namespace foam::inline runtime {

/// Runs the tasks on all cores. Keeps errors with their tasks, but lets cancellation pass.
template <class Task, class Body> void run_all(std::vector<Task>& tasks, Body&& body) {
    parallel_for(tasks.size(), [&](std::size_t i) {
        try {
            body(tasks[i]);
        } catch (const Error& error) {
            if (error.code() == ErrorCode::cancelled) {
                throw;
            }
            tasks[i].error.emplace(error);
        }
    });
}

/// Throws Error(plugin) for a triangle without its corners: later stages rely on valid indices. `kind`: of the stage.
void check_triangles(const Mesh& mesh, const char* kind);

} // namespace foam::inline runtime
