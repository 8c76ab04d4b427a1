// The bodies of an MJCF that is written whole: the tree of links with their inertias, joints and geoms.
#pragma once

#include "mjcf.hpp"
#include "mjcf_inertias.hpp"
#include "mjcf_joints.hpp"
#include "mjcf_visuals.hpp"

#include <foam/robot/kinematics.hpp>
#include <foam/sdk/context.hpp>
#include <foam/sdk/elements.hpp>
#include <foam/sdk/model.hpp>

#include <map>
#include <string>
#include <vector>

namespace foam::xml_models {

constexpr const char* world = "world"; ///< MuJoCo's name of the body that everything stands on

/// Writes the tree of bodies.
class MjcfBodies {
public:
    /// `free`: whether the base moves. `density`: of the geometry of links without mass, kg/m³.
    MjcfBodies(const SphereModel& model, const KnownKinds& known, bool free, double density, const MjcfVisuals& visuals,
               Context& context);

    /// Returns the content of <worldbody>. Throws Error(output) for what MuJoCo has no word for.
    std::string text();

    /// Returns the meshes of hulls. Call it after text().
    const std::vector<std::string>& meshes() const { return shapes_.meshes(); }
    /// Returns the joints that move and mimic no other, in the order of the bodies. Call it after text().
    std::vector<DrivenJoint> driven() const;
    /// Returns the <keyframe> with the rest pose; empty where all joints rest at zero. Call it after text():
    /// qpos has the order of the bodies. `targets`: whether the controls are the positions of driven().
    std::string keyframe(bool targets) const;
    bool has_shaped() const;

private:
    void keep_geometry();
    void line(std::size_t depth, const std::string& content) { text_ += std::string(2 * depth, ' ') + content + "\n"; }
    void add_body(const std::string& link, const Pose& pose, const Joint* joint, std::size_t depth);
    void add_geoms(const std::string& link, std::size_t depth);
    void add_children(const std::string& link, std::size_t depth);
    bool moves(const Joint& joint) const;
    JointValues rest_pose() const;
    double moved_inertia(const Joint& joint, const std::map<std::string, Pose>& poses) const;
    bool carries_mass(const std::string& link) const;

    const SphereModel& model_;
    const MjcfVisuals& visuals_;
    Context& context_;
    Kinematics kinematics_;
    bool free_;
    MjcfInertias inertias_;
    std::map<std::string, Elements> elements_; ///< of each link
    MjcfShapes shapes_;
    JointValues locked_;
    std::vector<std::size_t> joints_; ///< indices of those that move, in the order of the bodies
    std::string text_;
};

} // namespace foam::xml_models
