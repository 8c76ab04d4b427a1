// The meshes of a model: files, and vertices in its text.
#pragma once

#include "model.hpp"

#include <foam/base/error.hpp>
#include <foam/geometry/mesh.hpp>
#include <foam/robot/robot.hpp>
#include <foam/sdk/stage.hpp>

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace foam::mjcf {

/// A <mesh>: what it states, and what was read where it is wanted.
class MeshAsset {
public:
    MeshAsset(const Model& model, const Node& node);

    bool found() const { return !path_.empty() || uri_.empty(); }
    /// Whether its file and its scale are all there is to it, and a mesh loader reads the file.
    bool is_plain() const;
    /// Throws Error(input): its file is not found.
    [[noreturn]] void fail_missing(const Node& geom) const;

    /// Reads the mesh, and makes its hull; an error is kept for those who ask.
    void read(const MeshLoader* loader);
    /// Returns the mesh in the frame of a geom that names it: moved by refpos and refquat, and scaled.
    Mesh mesh() const;
    /// Returns the mesh, or its hull, for a link. It names no file where it is moved against that of the file.
    MeshReference surface() const;
    MeshReference hull() const;
    const Attributes& attributes() const { return attributes_; }
    /// Returns its file; empty: none is found, or the text has the mesh.
    const std::filesystem::path& path() const { return path_; }

    bool wanted = false, hull_wanted = false; ///< by a geom

private:
    Mesh read_raw(const MeshLoader* loader) const;
    Mesh of_text() const;
    void resolve(const Model& model);
    void require_read() const;
    MeshReference reference(std::shared_ptr<const Mesh> mesh) const;

    const Node& node_;
    Attributes attributes_;
    std::string uri_;            ///< as written; empty for a mesh of the text
    std::filesystem::path path_; ///< empty: not found
    std::vector<std::filesystem::path> tried_;
    Vec3 scale_{1, 1, 1};
    Pose reference_; ///< refpos and refquat
    /// As the file has it; moved and scaled where refpos or refquat are stated.
    std::shared_ptr<const Mesh> mesh_, hull_;
    std::optional<Error> error_;
};

/// The meshes that geoms name, each once.
class Meshes {
public:
    /// Returns the mesh of that name. Fails if the model has none.
    MeshAsset& named(const Model& model, const std::string& name, const Attributes& geom);
    /// Reads those that are wanted, in parallel.
    void read(const MeshLoader* loader);
    /// Returns the files that read() reads.
    std::vector<std::filesystem::path> files() const;

private:
    std::vector<MeshAsset*> wanted() const;

    std::map<const Node*, std::unique_ptr<MeshAsset>> assets_;
};

/// Returns the mesh of an MSH file, MuJoCo's own binary format. Throws Error(input) naming the file.
Mesh read_msh(const std::filesystem::path& file);

} // namespace foam::mjcf
