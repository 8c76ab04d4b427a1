#include "allocate/budget.hpp"

#include <foam/base/parallel.hpp>
#include <foam/collision/separation.hpp>
#include <foam/geometry/mesh_checks.hpp>
#include <foam/robot/internal/chain.hpp>
#include <foam/robot/kinematics.hpp>
#include <foam/runtime/internal/cover.hpp>
#include <foam/runtime/internal/links.hpp>
#include <foam/runtime/internal/output.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace foam::inline runtime {
namespace {

/// Returns the group states of the SRDFs that outputs edit.
std::vector<GroupState> poses_of_outputs(const Workspace& workspace) {
    std::vector<GroupState> poses;
    for (const OutputCall& output : workspace.recipe.outputs) {
        if (const std::optional<TextFile> into = into_of(workspace, output)) {
            const std::vector<GroupState> more = group_states(into->text, into->file.string());
            poses.insert(poses.end(), more.begin(), more.end());
        }
    }
    return poses;
}

bool needs_reference(const Workspace& workspace) {
    const auto& outputs = workspace.recipe.outputs;
    return workspace.recipe.self_collision || std::any_of(outputs.begin(), outputs.end(), [&](const OutputCall& output) {
               return workspace.registry.find(output.writer.stage)->info.consumer.rest_pose;
           });
}

/// Returns whether a corner of `a` lies in or on `b`. `pose`: of a in the frame of b.
bool reaches_into(const Solid& a, const Solid& b, const Pose& pose) {
    const Box& box = b.bounds();
    const double nothing = 1e-6 * box.diagonal();
    const auto near = [&](const Vec3& p) {
        return p.x >= box.low.x - nothing && p.x <= box.high.x + nothing && p.y >= box.low.y - nothing &&
               p.y <= box.high.y + nothing && p.z >= box.low.z - nothing && p.z <= box.high.z + nothing;
    };
    const std::vector<Vec3>& corners = a.surface().vertices;
    return std::any_of(corners.begin(), corners.end(), [&](const Vec3& corner) {
        const Vec3 point = pose * corner;
        return near(point) && b.signed_distance(point) <= nothing;
    });
}

/// Returns whether the surfaces intersect, or one solid reaches into the other. `pose`: of a in the frame of b.
bool touch(const Solid& a, const Solid& b, const Pose& pose) {
    if (reaches_into(a, b, pose) || reaches_into(b, a, pose.inverse())) {
        return true;
    }
    Mesh both = transformed(a.surface(), pose);
    append(both, b.surface());
    const std::size_t border = a.surface().triangles.size();
    const auto crossings = self_intersections(both);
    return std::any_of(crossings.begin(), crossings.end(),
                       [&](const auto& pair) { return pair.first < border && pair.second >= border; });
}

/// Returns the depth of the two elements that overlap most, of which at least one is no sphere. Not above 0: they are
/// apart by more than the rounding.
double depth_of_shaped(const Elements& a, const Elements& b) {
    constexpr double rounding = 1e-5;
    double deepest = -std::numeric_limits<double>::infinity();
    const auto compare = [&](const Element& s, const Element& t) {
        const Separation between = separation(s, t);
        const double reach = rounding * (bounds(s).diagonal() + bounds(t).diagonal()) / 2;
        deepest = std::max(deepest, between.low > 0 ? reach - between.low : reach + between.depth);
    };
    for (const Element& s : a.shaped()) {
        for (const Element& t : b) {
            compare(s, t);
        }
    }
    for (const Sphere& s : a.spheres()) {
        for (const Element& t : b.shaped()) {
            compare(element_of(s), t);
        }
    }
    return deepest;
}

/// Returns the depth of the two spheres that overlap most, m. Negative: their distance, less the possible rounding.
double depth(const std::vector<Sphere>& a, const std::vector<Sphere>& b) {
    constexpr double rounding = 1e-5;
    double deepest = -std::numeric_limits<double>::infinity();
    for (const Sphere& s : a) {
        for (const Sphere& t : b) {
            const double reach = (1 + rounding) * (s.radius + t.radius);
            deepest = std::max(deepest, reach - distance(s.center, t.center));
        }
    }
    return deepest;
}

} // namespace

LinkSolids solids_of(const Robot& robot, const std::vector<LinkWork>& links) {
    LinkSolids solids(robot.links.size());
    parallel_for(links.size(), [&](std::size_t i) {
        if (!links[i].error && !links[i].recipe.skip) {
            solids[static_cast<std::size_t>(links[i].link - robot.links.data())] = solid_of(links[i]);
        }
    });
    return solids;
}

std::optional<ReferenceConfiguration> reference_of(const Workspace& workspace, std::shared_ptr<const Robot> robot,
                                                   const std::vector<LinkWork>& links) {
    using Source = ReferenceConfiguration::Source;
    const Recipe& recipe = workspace.recipe;
    if (!needs_reference(workspace) || robot->joints.empty()) {
        return std::nullopt;
    }
    const Kinematics kinematics(robot);
    const JointValues& given =
        recipe.self_collision_pose.empty() ? recipe.facts.default_pose : recipe.self_collision_pose;
    ReferenceConfiguration reference;
    try {
        reference = reference_configuration(kinematics, solids_of(*robot, links),
                                            {.given = given,
                                             .named = poses_of_outputs(workspace),
                                             .held = recipe.facts.lock_joints,
                                             .seed = recipe.seed});
    } catch (const Error& error) {
        if (error.code() != ErrorCode::usage) {
            throw;
        }
        throw Error(ErrorCode::recipe, fmt::format("{}: {}",
                                                   recipe.self_collision_pose.empty() ? "robot.default_pose"
                                                                                      : "self_collision.pose",
                                                   error.what()));
    }
    if (!reference.touching.empty() || reference.source == Source::named || reference.source == Source::found) {
        workspace.journal.finding({reference.touching.empty() ? Severity::info : Severity::warning, "", "",
                                   sentence_about(kinematics, reference)});
    }
    return reference;
}

ReferencePose::ReferencePose(std::shared_ptr<const Robot> robot, const std::vector<double>& configuration,
                             const std::vector<LinkWork>& links)
    : links_(links) {
    const Kinematics kinematics(robot);
    const std::vector<Pose> poses = kinematics.link_poses(configuration);
    std::vector<bool> has_geometry(robot->links.size(), false);
    std::vector<std::size_t> index; // of each of our links in the robot
    for (const LinkWork& link : links) {
        index.push_back(static_cast<std::size_t>(link.link - robot->links.data()));
        has_geometry[index.back()] = true;
        poses_.push_back(poses[index.back()]);
    }
    neighbours_.assign(links.size(), std::vector<bool>(links.size(), true));
    for (std::size_t a = 0; a < links.size(); ++a) {
        for (std::size_t b = a + 1; b < links.size(); ++b) {
            const bool adjacent = joint_chain::adjacent(kinematics, has_geometry, index[a], index[b]);
            neighbours_[a][b] = neighbours_[b][a] = adjacent;
        }
    }
}

bool ReferencePose::geometry_touches(std::size_t a, std::size_t b) {
    const auto known = touching_.find({a, b});
    if (known != touching_.end()) {
        return known->second;
    }
    for (const std::size_t link : {a, b}) {
        if (!solids_.contains(link)) {
            solids_[link] = solid_of(links_[link]);
        }
    }
    return touching_[{a, b}] = touch(*solids_[a], *solids_[b], poses_[b].inverse() * poses_[a]);
}

std::vector<Overlap> ReferencePose::overlaps(const std::vector<ElementsOfLink>& all) {
    std::vector<Elements> placed;
    for (const ElementsOfLink& link : all) {
        placed.push_back(moved(link.elements, poses_[link.link]));
    }
    std::vector<Overlap> overlaps;
    for (std::size_t a = 0; a < all.size(); ++a) {
        for (std::size_t b = a + 1; b < all.size(); ++b) {
            if (neighbours_[all[a].link][all[b].link]) {
                continue;
            }
            const double deepest =
                std::max(depth(placed[a].spheres(), placed[b].spheres()), depth_of_shaped(placed[a], placed[b]));
            if (deepest > 0 && !geometry_touches(all[a].link, all[b].link)) {
                overlaps.push_back({a, b, deepest});
            }
        }
    }
    return overlaps;
}

} // namespace foam::runtime
