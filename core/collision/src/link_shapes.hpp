// The original geometry of a robot's links, to be tested for contact.
#pragma once

#include "ball_group.hpp"
#include "contact_shape.hpp"

#include <foam/collision/self_collision.hpp>

#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

namespace foam::inline collision {

/// The shape of each link, made when it is first needed: links that never come near another have none. Thread-safe.
class LinkShapes {
public:
    explicit LinkShapes(const LinkSolids& solids);

    /// Returns whether the geometry of the link is known.
    bool has(std::size_t link) const { return link < solids_.size() && solids_[link]; }
    std::vector<bool> have_geometry() const;
    /// Returns whether the geometry of two links touches. `poses`: of all links. False where it is not known.
    bool touching(std::size_t first, std::size_t second, std::span<const Pose> poses) const;

private:
    using BallGroup = self_collision::BallGroup;
    struct Shape {
        Sphere around;                      ///< contains the geometry
        std::optional<BallGroup> primitives; ///< all of the geometry, where there is no mesh
        std::once_flag made;
        std::unique_ptr<ContactShape> mesh; ///< once it is made
    };
    const ContactShape& mesh(std::size_t link) const;

    const LinkSolids& solids_;
    mutable std::vector<Shape> shapes_;
};

/// The shapes in one configuration; `touching` as PlacedLinks has it.
class PlacedShapes {
public:
    PlacedShapes(const Kinematics& kinematics, const LinkShapes& shapes)
        : kinematics_(kinematics), shapes_(shapes), poses_(kinematics.robot().links.size()) {}

    void place(std::span<const double> configuration) { kinematics_.link_poses(configuration, poses_); }
    bool touching(std::size_t first, std::size_t second) const { return shapes_.touching(first, second, poses_); }

private:
    const Kinematics& kinematics_;
    const LinkShapes& shapes_;
    std::vector<Pose> poses_;
};

/// Returns the pairs of links with geometry that are not adjacent, in the order of the links.
LinkPairs pairs_apart(const Kinematics& kinematics, const LinkShapes& shapes);

/// Returns those of the pairs whose geometry touches in every one of the configurations. Pairs that are apart in one are
/// not tested in the next.
LinkPairs touching_in_all(const Kinematics& kinematics, const LinkShapes& shapes, LinkPairs pairs,
                          const std::vector<std::vector<double>>& configurations);

} // namespace foam::inline collision
