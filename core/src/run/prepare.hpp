// Loading and filtering: every distinct mesh once, every distinct chain of filters on it once.
#pragma once

#include "workspace.hpp"

#include <foam/robot.hpp>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace foam {

/// A collision element on its way through the filters. Meshes are in the element's own frame, scaled, in metres.
struct Element {
    const GeometryElement* source = nullptr;
    std::string geometry;                              ///< mesh reference as written, or the primitive's kind
    std::shared_ptr<const Mesh> raw;                   ///< null for a primitive
    std::vector<std::shared_ptr<const Mesh>> filtered; ///< after each filter; empty for a primitive
    Digest digest;                                     ///< of raw geometry and filters, without the pose

    const std::shared_ptr<const Mesh>& processed() const { return filtered.empty() ? raw : filtered.back(); }
    const Primitive* primitive() const { return std::get_if<Primitive>(&source->geometry); }
};

struct InputFile {
    std::string reference; ///< as written in the robot
    std::filesystem::path file;
    Digest digest;
    std::size_t bytes = 0;
};

/// A link that is to become spheres.
struct LinkWork {
    const Link* link = nullptr;
    Recipe::LinkRecipe recipe;
    std::vector<Element> elements;
    LinkReport report;
    std::optional<Error> error;
};

/// Where a task's result goes: element `element` of link `link`.
struct Target {
    std::size_t link, element;
};

/// A chain of filters on a mesh, done once for all elements that share it.
struct FilterTask {
    std::shared_ptr<const Mesh> mesh;
    std::vector<StageCall> filters;
    Digest digest;
    std::vector<Target> targets;
    std::vector<std::shared_ptr<const Mesh>> results;
    std::vector<StageReport> reports;
    std::optional<Error> error;
};

/// The links with their meshes loaded. Errors as in prepare_links().
std::vector<LinkWork> load_links(const Workspace& workspace, const Robot& robot, std::vector<InputFile>& files);
/// The distinct chains of filters that loaded links need; gives elements their digests.
std::vector<FilterTask> filter_tasks(const Workspace& workspace, std::vector<LinkWork>& links);
/// What the cache knows the result of a filter on a mesh by. `content`: the mesh's digest.
Digest filter_key(const Workspace& workspace, const StageCall& filter, const Mesh& mesh, const Digest& content);

/// Runs the chains of filters on loaded links; errors are kept with them.
void filter_links(const Workspace& workspace, std::vector<LinkWork>& links);

/// load_links() and filter_links(): one entry for every link with collision geometry, in the robot's order; errors are
/// kept in the entry, except cancellation, which is thrown. `files`: the mesh files that were read.
std::vector<LinkWork> prepare_links(const Workspace& workspace, const Robot& robot, std::vector<InputFile>& files);

/// The mesh files that prepare_links() would read, without loading them; those that cannot be read are left out.
std::vector<InputFile> mesh_files(const Workspace& workspace, const Robot& robot);

} // namespace foam
