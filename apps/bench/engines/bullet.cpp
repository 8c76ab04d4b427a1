// Bullet in double precision. A link is a compound shape; a mesh is its convex hull, as in PyBullet, without a margin.
// Distances are signed: penetration is negative.
#include <foam/bench/collision_engine.hpp>

#include <btBulletCollisionCommon.h>

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace foam {
namespace {

btVector3 to_bullet(const Vec3& v) {
    return {v.x, v.y, v.z};
}

btTransform to_bullet(const Pose& pose) {
    const auto& r = pose.rotation;
    return btTransform(btMatrix3x3(r[0].x, r[0].y, r[0].z, r[1].x, r[1].y, r[1].z, r[2].x, r[2].y, r[2].z),
                       to_bullet(pose.translation));
}

/// Margins would round corners and make hulls larger; the radius of a sphere or capsule is all margin.
std::unique_ptr<btCollisionShape> without_margin(std::unique_ptr<btCollisionShape> shape) {
    shape->setMargin(0);
    return shape;
}

std::unique_ptr<btCollisionShape> make_shape(const Element& p) {
    switch (p.kind) {
    case Element::Kind::box:
        return without_margin(std::make_unique<btBoxShape>(to_bullet(p.half)));
    case Element::Kind::sphere:
        return std::make_unique<btSphereShape>(p.radius);
    case Element::Kind::cylinder:
        return without_margin(std::make_unique<btCylinderShapeZ>(btVector3(p.radius, p.radius, p.half.z)));
    case Element::Kind::capsule:
        return std::make_unique<btCapsuleShapeZ>(p.radius, 2 * p.half.z);
    case Element::Kind::ellipsoid:
    case Element::Kind::swept_box:
    case Element::Kind::hull:
        break; // a mesh
    }
    return nullptr;
}

std::unique_ptr<btCollisionShape> make_shape(const std::shared_ptr<const Mesh>& mesh) {
    auto hull = std::make_unique<btConvexHullShape>();
    for (const Vec3& v : mesh->vertices) {
        hull->addPoint(to_bullet(v), false);
    }
    hull->optimizeConvexHull();
    hull->recalcLocalAabb();
    return without_margin(std::move(hull));
}

/// A link or an obstacle in the world.
struct Body {
    std::vector<std::unique_ptr<btCollisionShape>> parts;
    std::unique_ptr<btCollisionShape> shape;
    btCollisionObject object;

    void set_shape(std::unique_ptr<btCollisionShape> made) {
        shape = std::move(made);
        object.setCollisionShape(shape.get());
    }
};

constexpr int obstacle_index = -1;

/// Whether anything that is asked for touches.
struct Touching final : btCollisionWorld::ContactResultCallback {
    std::function<bool(int)> asked; ///< by the index of the other object
    bool every_pair = false;        ///< also after the first that touches
    bool found = false;

    bool needsCollision(btBroadphaseProxy* proxy) const override {
        return (every_pair || !found) &&
               asked(static_cast<const btCollisionObject*>(proxy->m_clientObject)->getUserIndex());
    }
    btScalar addSingleResult(btManifoldPoint& point, const btCollisionObjectWrapper*, int, int,
                             const btCollisionObjectWrapper*, int, int) override {
        found = found || point.getDistance() <= 0;
        return 0;
    }
};

/// The least distance; pairs that are farther apart are left out as early as Bullet can.
struct Nearest final : btCollisionWorld::ContactResultCallback {
    double least = std::numeric_limits<double>::infinity();

    void prepare() {
        constexpr double far = 1e3; // m
        m_closestDistanceThreshold = std::clamp(least, 0.0, far);
    }
    btScalar addSingleResult(btManifoldPoint& point, const btCollisionObjectWrapper*, int, int,
                             const btCollisionObjectWrapper*, int, int) override {
        least = std::min(least, point.getDistance());
        return 0;
    }
};

class Bullet final : public CollisionEngine {
public:
    Bullet(const EngineRobot& robot, const std::vector<Obstacle>& obstacles)
        : pairs_(robot.pairs), partners_(robot.bodies.size()) {
        for (std::size_t b = 0; b < robot.bodies.size(); ++b) {
            Body& link = *links_.emplace_back(std::make_unique<Body>());
            add(link, compound(link, robot.bodies[b]), static_cast<int>(b));
        }
        for (const Obstacle& obstacle : obstacles) {
            add(*obstacles_.emplace_back(std::make_unique<Body>()), make_shape(obstacle.shape), obstacle_index);
        }
        for (const auto& [a, b] : pairs_) {
            partners_[a].push_back(static_cast<int>(b));
        }
    }
    ~Bullet() override {
        for (const auto* bodies : {&links_, &obstacles_}) {
            for (const auto& body : *bodies) {
                world_.removeCollisionObject(&body->object);
            }
        }
    }

    void set_obstacles(const std::vector<Obstacle>& obstacles) override {
        for (std::size_t i = 0; i < obstacles.size(); ++i) {
            obstacles_[i]->set_shape(make_shape(obstacles[i].shape));
            place(*obstacles_[i], obstacles[i].pose);
        }
    }
    void move(std::span<const Pose> poses) override {
        for (std::size_t b = 0; b < links_.size(); ++b) {
            place(*links_[b], poses[b]);
        }
    }
    bool hits_obstacle() override {
        return touches([](std::size_t) { return [](int other) { return other == obstacle_index; }; }, false);
    }
    bool hits_itself(bool every_pair) override {
        const auto partner_of = [this](std::size_t b) {
            return [&partners = partners_[b]](int other) {
                return std::find(partners.begin(), partners.end(), other) != partners.end();
            };
        };
        return touches(partner_of, every_pair);
    }
    double distance_to_obstacles() override {
        Nearest nearest;
        for (const auto& link : links_) {
            for (const auto& obstacle : obstacles_) {
                nearest.prepare();
                world_.contactPairTest(&link->object, &obstacle->object, nearest);
            }
        }
        return nearest.least;
    }
    double distance_to_itself() override {
        Nearest nearest;
        for (const auto& [a, b] : pairs_) {
            nearest.prepare();
            world_.contactPairTest(&links_[a]->object, &links_[b]->object, nearest);
        }
        return nearest.least;
    }

private:
    static std::unique_ptr<btCollisionShape> compound(Body& body, const EngineBody& shapes) {
        auto result = std::make_unique<btCompoundShape>();
        for (const EngineShape& shape : shapes) {
            body.parts.push_back(std::visit([](const auto& g) { return make_shape(g); }, shape.geometry));
            result->addChildShape(to_bullet(shape.pose), body.parts.back().get());
        }
        return result;
    }
    void add(Body& body, std::unique_ptr<btCollisionShape> shape, int index) {
        body.set_shape(std::move(shape));
        body.object.setUserIndex(index);
        world_.addCollisionObject(&body.object);
    }
    void place(Body& body, const Pose& pose) {
        body.object.setWorldTransform(to_bullet(pose));
        world_.updateSingleAabb(&body.object);
    }
    template <class Filter> bool touches(Filter&& filter, bool every_pair) {
        Touching touching;
        touching.every_pair = every_pair;
        for (std::size_t b = 0; b < links_.size() && (every_pair || !touching.found); ++b) {
            touching.asked = filter(b);
            world_.contactTest(&links_[b]->object, touching);
        }
        return touching.found;
    }

    btDefaultCollisionConfiguration configuration_;
    btCollisionDispatcher dispatcher_{&configuration_};
    btDbvtBroadphase broadphase_;
    btCollisionWorld world_{&dispatcher_, &broadphase_, &configuration_};
    std::vector<std::unique_ptr<Body>> links_, obstacles_;
    std::vector<std::array<std::uint32_t, 2>> pairs_;
    std::vector<std::vector<int>> partners_; ///< of each link, those of a higher index
};

} // namespace
} // namespace foam

int main() {
    using namespace foam;
    return serve_engine(fmt::format("Bullet {}.{}", btGetVersion() / 100, btGetVersion() % 100),
                        [](const std::string&, const EngineRobot& robot, const std::vector<Obstacle>& obstacles) {
                            return std::make_unique<Bullet>(robot, obstacles);
                        });
}
