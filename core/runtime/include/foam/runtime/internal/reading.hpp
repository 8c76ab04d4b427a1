// Robots and meshes from files, without a recipe: what was read, and how it is read.
#pragma once

#include <foam/base/internal/files.hpp>
#include <foam/robot/robot.hpp>
#include <foam/runtime/internal/workspace.hpp>

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] runtime {

/// Where references are looked for, and how loaders are called.
struct Reading {
    ResourceResolver resources = ResourceResolver::from_environment();
    MeshUnit unit{};                ///< of a single mesh
    std::string preferred_loader{}; ///< the one with precedence where several read an ending; may be empty
    /// Returns the call of a loader: with parameters of a recipe, or with none.
    std::function<StageCall(const std::string& loader)> call = [](const std::string& loader) {
        return StageCall{loader, {}, {}};
    };
    /// The name that the content of a robot's file goes by: messages have it, and relative references lead from its
    /// folder. It need not exist; empty: the file's own.
    std::filesystem::path name{};
};

struct InputFile {
    std::string reference; ///< as written in the robot
    std::filesystem::path file;
    Digest digest;
    std::size_t bytes = 0;
};

/// A mesh that was read.
struct LoadedMesh {
    MeshReference reference; ///< the first that leads to it at this scale
    InputFile file;
    std::shared_ptr<const Mesh> mesh; ///< scaled, m
    StageReport report;               ///< of its loader
    StageLog log;                     ///< of its loader
};

/// A robot or a mesh that was read.
struct LoadedInput {
    std::string chosen;         ///< a recipe's candidate, as written; else the file
    std::filesystem::path file; ///< that was read
    /// As it stands in the file; for a single mesh a robot with one link.
    std::shared_ptr<const Robot> robot;
    Digest digest;         ///< of the file
    std::size_t bytes = 0; ///< of the file
    StageReport report;    ///< of the loader; its stage is empty for a single mesh
    StageLog log;          ///< of the loader
    std::vector<LoadedMesh> meshes{}; ///< those that were kept; others are read when they are needed
};

/// A collision element and its meshes after each filter, in the element's own frame, scaled, in metres.
struct CollisionElement {
    const GeometryElement* source = nullptr;
    std::string geometry;                              ///< mesh reference as written, or the kind of primitive
    std::shared_ptr<const Mesh> raw;                   ///< null for a primitive
    Digest read;                                       ///< of `raw` as it was loaded
    std::vector<std::shared_ptr<const Mesh>> filtered; ///< after each filter; empty for a primitive
    Digest digest;                                     ///< of raw geometry and filters, without the pose

    const std::shared_ptr<const Mesh>& processed() const { return filtered.empty() ? raw : filtered.back(); }
    const Element* primitive() const { return std::get_if<Element>(&source->geometry); }
};

/// A link with collision geometry and its meshes.
struct LoadedLink {
    const Link* link = nullptr;
    std::vector<CollisionElement> elements; ///< none if the link was not to be loaded
    std::vector<StageReport> loaders;       ///< of its meshes
    std::optional<Error> error;             ///< why it could not be loaded, or not be worked on
    Covers covers = Covers::solid;          ///< what elements are to hold
};

/// The links of a robot that have collision geometry, in its order.
struct LoadedLinks {
    std::vector<LoadedLink> links;
    std::vector<InputFile> files;   ///< the mesh files that were read
    std::vector<LoadedMesh> meshes; ///< those without error
};

/// Returns the loader for a mesh file by its extension; null if there is none.
const RegisteredStage* mesh_loader_of(const Registry& registry, const Reading& reading,
                                      const std::filesystem::path& file);

/// Returns the path of a mesh. Throws Error(input) with the reference's problem if there is none.
const std::filesystem::path& path_of(const MeshReference& reference);

/// Returns the file of a mesh with its digest; it has at most as many bytes as its loader's parameter max_bytes allows.
/// Throws Error(input).
InputFile mesh_file_of(const Registry& registry, const Reading& reading, const MeshReference& reference);

/// Reads a robot, or a mesh as a robot with one link; meshes of a robot are not read. `chosen`: the file as the user
/// wrote it. Throws Error(input) for what cannot be read, Error(usage) for a unit of a file that states its own.
LoadedInput read_input(const Calls& calls, const Reading& reading, const std::filesystem::path& file, InputKind kind,
                       const std::string& chosen);

/// Loads the meshes of the collision elements of the links that `wanted` accepts, each distinct file and scale once,
/// all in parallel. `known`: meshes that are not read again. Errors are kept with the links, except cancellation, which
/// is thrown.
LoadedLinks load_links(const Calls& calls, const Reading& reading, const Robot& robot,
                       const std::function<bool(const Link&)>& wanted, const std::vector<LoadedMesh>& known);

/// Throws Error(input) for a robot without geometry to be covered; `to`: what for. Names the remedy.
[[noreturn]] void refuse_without_geometry(const std::filesystem::path& file, const Robot& robot,
                                          CoveredGeometry geometry, const char* to);

/// Returns the references of these links to meshes, each distinct file and scale once.
std::vector<MeshReference> mesh_references(const Robot& robot, const std::function<bool(const Link&)>& wanted);

} // namespace runtime
} // namespace foam
