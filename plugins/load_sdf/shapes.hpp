// Shapes of SDF in the words of foam::Robot.
#pragma once

#include "document.hpp"
#include "newer.hpp"

#include <foam/robot/robot.hpp>
#include <foam/sdk/stage.hpp>

#include <sdf/Collision.hh>
#include <sdf/Link.hh>
#include <sdf/Mesh.hh>
#include <sdf/Visual.hh>

#include <optional>

namespace foam::load_sdf {

/// Returns the pose of a rotation and a place.
Pose pose_of(const ignition::math::Pose3d& pose);

/// What hulls of meshes are made of.
struct HullSources {
    const std::string& text;  ///< the main file's
    const MeshLoader* meshes; ///< null: no plugin has one
};

/// Reads collisions and visuals.
class Shapes {
public:
    Shapes(const Document& document, const References& references, HullSources hulls, Context& context)
        : document_(document), references_(references), optimizations_(hulls.text), meshes_(hulls.meshes),
          context_(context) {}

    /// Adds the geometry of a link.
    void add(Link& link, const ::sdf::Link& source);
    /// Logs what no element covers.
    void report() const;

private:
    std::optional<GeometryElement> collision(const ::sdf::Collision& source, const std::string& link);
    std::optional<GeometryElement> visual(const ::sdf::Visual& source, const std::string& link);
    template <class Source>
    std::optional<GeometryElement> element(const Source& source, const std::string& link, bool& ground) const;
    std::optional<Geometry> shape(const ::sdf::Geometry& geometry, const ::sdf::ElementPtr& element,
                                  const std::string& link, bool& ground) const;
    MeshReference mesh(const ::sdf::Mesh& source, const std::string& link) const;
    std::optional<Geometry> other_shape(const ::sdf::Geometry& geometry, const ::sdf::ElementPtr& element) const;
    MeshReference cone(const ::sdf::ElementPtr& source) const;
    void take_hull(MeshReference& mesh, const ::sdf::Mesh& source);
    MeshReference polyline(const ::sdf::ElementPtr& source) const;
    double above_zero(double size, const char* what, const ::sdf::ElementPtr& element) const;

    const Document& document_;
    const References& references_;
    Optimizations optimizations_;
    const MeshLoader* meshes_;
    Context& context_;
    std::size_t ground_ = 0, masked_ = 0;
};

} // namespace foam::load_sdf
