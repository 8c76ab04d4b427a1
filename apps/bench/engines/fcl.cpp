// The Flexible Collision Library. "fcl": dynamic AABB trees over the robot's shapes and over the obstacles, as planners
// use it. "fcl_pairs": every shape against every other, as Pinocchio does. Meshes are surfaces. Distances are unsigned:
// in collision they are 0 or less, whatever the depth.
#include <foam/bench/collision_engine.hpp>

#include <fcl/fcl.h>

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <set>

namespace foam {
namespace {

constexpr std::int64_t obstacle_body = -1;

fcl::Transform3d to_fcl(const Pose& pose) {
    fcl::Transform3d result = fcl::Transform3d::Identity();
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) {
            result.linear()(row, column) = pose.rotation[static_cast<std::size_t>(row)][column];
        }
        result.translation()(row) = pose.translation[row];
    }
    return result;
}

std::shared_ptr<fcl::CollisionGeometryd> to_fcl(const Element& p) {
    switch (p.kind) {
    case Element::Kind::box:
        return std::make_shared<fcl::Boxd>(2 * p.half.x, 2 * p.half.y, 2 * p.half.z);
    case Element::Kind::sphere:
        return std::make_shared<fcl::Sphered>(p.radius);
    case Element::Kind::cylinder:
        return std::make_shared<fcl::Cylinderd>(p.radius, 2 * p.half.z);
    case Element::Kind::capsule:
        return std::make_shared<fcl::Capsuled>(p.radius, 2 * p.half.z);
    case Element::Kind::ellipsoid:
        return std::make_shared<fcl::Ellipsoidd>(p.half.x, p.half.y, p.half.z);
    case Element::Kind::swept_box:
    case Element::Kind::hull:
        break; // a mesh
    }
    return nullptr;
}

std::shared_ptr<fcl::CollisionGeometryd> surface_of(const Mesh& mesh) {
    std::vector<fcl::Vector3d> vertices;
    std::vector<fcl::Triangle> triangles;
    for (const Vec3& v : mesh.vertices) {
        vertices.emplace_back(v.x, v.y, v.z);
    }
    for (const Triangle& t : mesh.triangles) {
        triangles.emplace_back(t[0], t[1], t[2]);
    }
    auto model = std::make_shared<fcl::BVHModel<fcl::OBBRSSd>>();
    model->beginModel(static_cast<int>(triangles.size()), static_cast<int>(vertices.size()));
    model->addSubModel(vertices, triangles);
    model->endModel();
    return model;
}

std::shared_ptr<fcl::CollisionGeometryd> convex_solid_of(const Mesh& mesh) {
    auto vertices = std::make_shared<std::vector<fcl::Vector3d>>();
    auto faces = std::make_shared<std::vector<int>>();
    for (const Vec3& v : mesh.vertices) {
        vertices->emplace_back(v.x, v.y, v.z);
    }
    for (const Triangle& t : mesh.triangles) {
        faces->insert(faces->end(), {3, static_cast<int>(t[0]), static_cast<int>(t[1]), static_cast<int>(t[2])});
    }
    return std::make_shared<fcl::Convexd>(vertices, static_cast<int>(mesh.triangles.size()), faces);
}

std::shared_ptr<fcl::CollisionGeometryd> to_fcl(const EngineShape& shape) {
    if (const auto* primitive = std::get_if<Element>(&shape.geometry)) {
        return to_fcl(*primitive);
    }
    const Mesh& mesh = *std::get<std::shared_ptr<const Mesh>>(shape.geometry);
    return shape.convex ? convex_solid_of(mesh) : surface_of(mesh);
}

/// A shape that moves with a body.
struct Part {
    std::int64_t body = 0;
    Pose pose; ///< in the body's frame
    std::unique_ptr<fcl::CollisionObjectd> object;
};

using Parts = std::vector<std::unique_ptr<Part>>;

Part& part_of(const fcl::CollisionObjectd* object) {
    return *static_cast<Part*>(object->getUserData());
}

std::unique_ptr<Part> make_part(std::int64_t body, const Pose& pose, std::shared_ptr<fcl::CollisionGeometryd> shape) {
    auto part = std::make_unique<Part>();
    part->body = body;
    part->pose = pose;
    part->object = std::make_unique<fcl::CollisionObjectd>(std::move(shape), to_fcl(pose));
    part->object->setUserData(part.get());
    return part;
}

/// Obstacles and pairs of bodies that are tested.
class Tested {
public:
    Tested(std::size_t bodies, const std::vector<std::array<std::uint32_t, 2>>& pairs)
        : bodies_(bodies), tested_(bodies * bodies, false) {
        for (const auto& [a, b] : pairs) {
            tested_[a * bodies + b] = tested_[b * bodies + a] = true;
        }
    }
    bool operator()(const Part& a, const Part& b) const {
        return a.body == obstacle_body || b.body == obstacle_body ||
               tested_[static_cast<std::size_t>(a.body) * bodies_ + static_cast<std::size_t>(b.body)];
    }

private:
    std::size_t bodies_;
    std::vector<bool> tested_;
};

bool collide(fcl::CollisionObjectd* a, fcl::CollisionObjectd* b) {
    const fcl::CollisionRequestd request(1, false);
    fcl::CollisionResultd result;
    fcl::collide(a, b, request, result);
    return result.isCollision();
}

double distance_between(fcl::CollisionObjectd* a, fcl::CollisionObjectd* b) {
    const fcl::DistanceRequestd request;
    fcl::DistanceResultd result;
    fcl::distance(a, b, request, result);
    return result.min_distance;
}

struct CollisionSearch {
    const Tested& tested;
    bool every_pair = false;
    bool found = false;

    static bool visit(fcl::CollisionObjectd* a, fcl::CollisionObjectd* b, void* data) {
        auto& search = *static_cast<CollisionSearch*>(data);
        if (search.tested(part_of(a), part_of(b)) && collide(a, b)) {
            search.found = true;
        }
        return search.found && !search.every_pair;
    }
};

struct DistanceSearch {
    const Tested& tested;
    double least = std::numeric_limits<double>::infinity();

    static bool visit(fcl::CollisionObjectd* a, fcl::CollisionObjectd* b, void* data, double& bound) {
        auto& search = *static_cast<DistanceSearch*>(data);
        if (search.tested(part_of(a), part_of(b))) {
            search.least = std::min(search.least, distance_between(a, b));
        }
        bound = search.least;
        return search.least <= 0;
    }
};

class Fcl : public CollisionEngine {
public:
    explicit Fcl(const EngineRobot& robot) : tested_(robot.bodies.size(), robot.pairs) {
        for (std::size_t b = 0; b < robot.bodies.size(); ++b) {
            for (const EngineShape& shape : robot.bodies[b]) {
                parts_.push_back(make_part(static_cast<std::int64_t>(b), shape.pose, to_fcl(shape)));
            }
        }
    }

    void set_obstacles(const std::vector<Obstacle>& obstacles) override {
        obstacles_.clear();
        for (const Obstacle& obstacle : obstacles) {
            obstacles_.push_back(make_part(obstacle_body, obstacle.pose, to_fcl(obstacle.shape)));
            obstacles_.back()->object->computeAABB();
        }
    }

    void move(std::span<const Pose> poses) override {
        for (const auto& part : parts_) {
            part->object->setTransform(to_fcl(poses[static_cast<std::size_t>(part->body)] * part->pose));
            part->object->computeAABB();
        }
    }

protected:
    Tested tested_;
    Parts parts_, obstacles_;
};

class Trees final : public Fcl {
public:
    explicit Trees(const EngineRobot& robot) : Fcl(robot) { fill(robot_tree_, parts_); }

    void set_obstacles(const std::vector<Obstacle>& obstacles) override {
        obstacle_tree_.clear();
        Fcl::set_obstacles(obstacles);
        fill(obstacle_tree_, obstacles_);
    }
    void move(std::span<const Pose> poses) override {
        Fcl::move(poses);
        robot_tree_.update();
    }
    bool hits_obstacle() override {
        CollisionSearch search{tested_};
        robot_tree_.collide(&obstacle_tree_, &search, CollisionSearch::visit);
        return search.found;
    }
    bool hits_itself(bool every_pair) override {
        CollisionSearch search{tested_, every_pair};
        robot_tree_.collide(&search, CollisionSearch::visit);
        return search.found;
    }
    double distance_to_obstacles() override {
        DistanceSearch search{tested_};
        robot_tree_.distance(&obstacle_tree_, &search, DistanceSearch::visit);
        return search.least;
    }
    double distance_to_itself() override {
        DistanceSearch search{tested_};
        robot_tree_.distance(&search, DistanceSearch::visit);
        return search.least;
    }

private:
    using Tree = fcl::DynamicAABBTreeCollisionManagerd;
    static void fill(Tree& tree, const Parts& parts) {
        std::vector<fcl::CollisionObjectd*> objects;
        for (const auto& part : parts) {
            objects.push_back(part->object.get());
        }
        tree.registerObjects(objects);
        tree.setup();
    }
    Tree robot_tree_, obstacle_tree_;
};

class Pairs final : public Fcl {
public:
    explicit Pairs(const EngineRobot& robot) : Fcl(robot) {
        for (std::size_t i = 0; i < parts_.size(); ++i) {
            for (std::size_t j = i + 1; j < parts_.size(); ++j) {
                if (tested_(*parts_[i], *parts_[j])) {
                    own_.emplace_back(parts_[i]->object.get(), parts_[j]->object.get());
                }
            }
        }
    }

    bool hits_obstacle() override {
        return any_with_obstacle([](auto* a, auto* b) { return collide(a, b); });
    }
    bool hits_itself(bool every_pair) override {
        bool found = false;
        for (const auto& [a, b] : own_) {
            found = collide(a, b) || found;
            if (found && !every_pair) {
                break;
            }
        }
        return found;
    }
    double distance_to_obstacles() override {
        double result = std::numeric_limits<double>::infinity();
        any_with_obstacle([&](auto* a, auto* b) {
            result = std::min(result, distance_between(a, b));
            return false;
        });
        return result;
    }
    double distance_to_itself() override {
        double result = std::numeric_limits<double>::infinity();
        for (const auto& [a, b] : own_) {
            result = std::min(result, distance_between(a, b));
        }
        return result;
    }

private:
    /// Whether the condition holds for a shape and an obstacle; later ones are not looked at.
    template <class Condition> bool any_with_obstacle(Condition&& condition) const {
        return std::any_of(parts_.begin(), parts_.end(), [&](const auto& a) {
            return std::any_of(obstacles_.begin(), obstacles_.end(),
                               [&](const auto& b) { return condition(a->object.get(), b->object.get()); });
        });
    }

    std::vector<std::pair<fcl::CollisionObjectd*, fcl::CollisionObjectd*>> own_; ///< of the robot's shapes
};

} // namespace
} // namespace foam

int main() {
    using namespace foam;
    return serve_engine("FCL " FCL_VERSION, [](const std::string& name, const EngineRobot& robot, const auto&) {
        return name == "fcl_pairs" ? std::unique_ptr<CollisionEngine>(std::make_unique<Pairs>(robot))
                                   : std::make_unique<Trees>(robot);
    });
}
