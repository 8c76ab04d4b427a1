// Geoms: what collides, and what is seen.
#pragma once

#include "meshes.hpp"
#include "model.hpp"

#include <foam/robot/robot.hpp>
#include <foam/sdk/context.hpp>

#include <memory>
#include <optional>
#include <string>

namespace foam::mjcf {

/// A geom, as it stands in a body.
struct Geom {
    Attributes attributes; ///< with those of its class
    const Node* node = nullptr;
    const Model* model = nullptr;
    Pose frame{};         ///< from that of the <frame> elements around it to the body's
    std::string name{};   ///< with the prefix of <attach> and the suffix of <replicate>
    std::size_t link = 0; ///< index into Robot::links
    bool paired = false;  ///< a <pair> names it
    MeshAsset* mesh = nullptr;

    std::string type() const { return attributes.word("type", "sphere"); }
    /// Whether it is a mesh itself, not a primitive that is fitted to one.
    bool is_mesh() const { return type() == "mesh" || type() == "sdf"; }
    /// Whether it is a plane or a height field, which no elements cover.
    bool is_ground() const { return type() == "plane" || type() == "hfield"; }
    bool collides() const;
    /// Whether MuJoCo shows it at first look: without contact, or in one of the groups 0 to 2.
    bool is_seen() const;
};

/// Makes the geometry of geoms.
class Shapes {
public:
    /// `hulls`: a mesh collides as its convex hull, as in MuJoCo; else as it is.
    explicit Shapes(bool hulls) : hulls_(hulls) {}

    /// Names the mesh of a geom, and marks what is wanted of it.
    void prepare(Geom& geom);
    void read(const MeshLoader* loader) { meshes_.read(loader); }
    /// Returns the files that read() reads.
    std::vector<std::filesystem::path> files() const { return meshes_.files(); }
    /// Returns what collides. Throws Error(input) naming file and line.
    GeometryElement collision(const Geom& geom) const;
    /// Returns what is seen; nothing with a warning for a mesh that is not found.
    std::optional<GeometryElement> visual(const Geom& geom, Context& context) const;

private:
    Meshes meshes_;
    bool hulls_;
};

} // namespace foam::mjcf
