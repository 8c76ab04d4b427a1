// The interface to collision libraries: queries about a robot among obstacles. Each library has a program of its own,
// so that foam depends on none of them and survives when one aborts.
#pragma once

#include <foam/geometry/mesh.hpp>
#include <foam/geometry/vector.hpp>
#include <foam/robot/robot.hpp>

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] bench {

/// A solid in the frame of its body; metres. A mesh is in the frame of the shape.
struct EngineShape {
    Pose pose;
    std::variant<Element, std::shared_ptr<const Mesh>> geometry;
    bool convex = false; ///< whether a mesh is the surface of a convex solid, which libraries take as one where they can
};

/// A link.
using EngineBody = std::vector<EngineShape>;

struct EngineRobot {
    std::vector<EngineBody> bodies;
    std::vector<std::array<std::uint32_t, 2>> pairs; ///< bodies that are tested against each other, lower index first
};

/// A box or a sphere, in the frame of the robot's root.
struct Obstacle {
    Pose pose;
    Element shape;
};

/// A robot and obstacles in a collision library.
class CollisionEngine {
public:
    virtual ~CollisionEngine();
    CollisionEngine(const CollisionEngine&) = delete;
    CollisionEngine& operator=(const CollisionEngine&) = delete;

    /// Replaces the obstacles one by one. Precondition: as many as before, of the same kinds.
    virtual void set_obstacles(const std::vector<Obstacle>& obstacles) = 0;
    /// Sets the poses of the bodies in the frame of the robot's root.
    virtual void move(std::span<const Pose> poses) = 0;
    /// Returns whether the robot hits an obstacle. May stop at the first collision.
    virtual bool hits_obstacle() = 0;
    /// Returns whether two bodies of a pair touch. `every_pair`: looks at all pairs, also after the first collision.
    virtual bool hits_itself(bool every_pair) = 0;
    /// Returns the distance, m; 0 or below in collision; infinity if there is no pair.
    virtual double distance_to_obstacles() = 0;
    virtual double distance_to_itself() = 0;

protected:
    CollisionEngine();
};

/// Makes an engine. `name`: of the engine, where a program has several.
using EngineMaker = std::function<std::unique_ptr<CollisionEngine>(const std::string& name, const EngineRobot& robot,
                                                                   const std::vector<Obstacle>& obstacles)>;

/// Implements the whole main() of an engine's program: reads a problem from standard input, runs the queries and
/// answers to the process that started it. `version`: of the library.
int serve_engine(const std::string& version, const EngineMaker& make);

} // namespace bench
} // namespace foam
