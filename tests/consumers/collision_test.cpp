// FCL and Bullet with the spheres of a URDF of foam, as MoveIt and PyBullet load them: touching pairs of links and
// their distances are those of the model.
#include "urdfdom_robot.hpp"

#include <btBulletCollisionCommon.h>
#include <fcl/fcl.h>

#include <limits>

namespace foam::test {
namespace {

/// A link with spheres, in the world.
struct Body {
    std::string link;
    Pose pose;
    std::vector<Sphere> spheres; ///< in the link's frame
};

std::vector<Body> bodies_of(const urdf::ModelInterface& robot, const JointValues& values) {
    std::vector<Body> bodies;
    for (const auto& [name, link] : robot.links_) {
        if (!link->collision_array.empty()) {
            bodies.push_back({name, pose_of(*link, values), spheres_of(*link)});
        }
    }
    return bodies;
}

/// The least distance of two links, negative where they overlap; m.
double least_distance(const std::vector<Sphere>& a, const std::vector<Sphere>& b) {
    double least = std::numeric_limits<double>::infinity();
    for (const Sphere& s : a) {
        for (const Sphere& t : b) {
            least = std::min(least, distance(s.center, t.center) - s.radius - t.radius);
        }
    }
    return least;
}

std::vector<std::unique_ptr<fcl::CollisionObjectd>> fcl_objects(const Body& body) {
    std::vector<std::unique_ptr<fcl::CollisionObjectd>> objects;
    for (const Sphere& sphere : body.spheres) {
        const Vec3 at = body.pose * sphere.center;
        fcl::Transform3d pose = fcl::Transform3d::Identity();
        pose.translation() = fcl::Vector3d(at.x, at.y, at.z);
        objects.push_back(std::make_unique<fcl::CollisionObjectd>(std::make_shared<fcl::Sphered>(sphere.radius), pose));
    }
    return objects;
}

void expect_fcl(const Body& first, const Body& second, double expected) {
    double least = std::numeric_limits<double>::infinity();
    bool touch = false;
    const auto ours = fcl_objects(first), others = fcl_objects(second);
    for (const auto& a : ours) {
        for (const auto& b : others) {
            fcl::CollisionResultd contact;
            touch = fcl::collide(a.get(), b.get(), fcl::CollisionRequestd(), contact) > 0 || touch;
            fcl::DistanceResultd result;
            least = std::min(least, fcl::distance(a.get(), b.get(), fcl::DistanceRequestd(), result));
        }
    }
    EXPECT_EQ(touch, expected <= 0) << first.link << ", " << second.link;
    if (expected > 0) {
        EXPECT_NEAR(least, expected, rounding) << first.link << ", " << second.link;
    }
}

/// A link as PyBullet makes it: spheres within one compound.
struct BulletLink {
    explicit BulletLink(const Body& body) {
        for (const Sphere& sphere : body.spheres) {
            spheres.push_back(std::make_unique<btSphereShape>(sphere.radius));
            shape.addChildShape(
                btTransform(btQuaternion::getIdentity(), btVector3(sphere.center.x, sphere.center.y, sphere.center.z)),
                spheres.back().get());
        }
        const auto& r = body.pose.rotation;
        object.setCollisionShape(&shape);
        object.setWorldTransform(
            btTransform(btMatrix3x3(r[0].x, r[0].y, r[0].z, r[1].x, r[1].y, r[1].z, r[2].x, r[2].y, r[2].z),
                        btVector3(body.pose.translation.x, body.pose.translation.y, body.pose.translation.z)));
    }
    btCompoundShape shape;
    std::vector<std::unique_ptr<btSphereShape>> spheres;
    btCollisionObject object;
};

struct LeastDistance final : btCollisionWorld::ContactResultCallback {
    LeastDistance() { m_closestDistanceThreshold = 100; } // m
    btScalar addSingleResult(btManifoldPoint& point, const btCollisionObjectWrapper*, int, int,
                             const btCollisionObjectWrapper*, int, int) override {
        least = std::min(least, point.getDistance());
        return 0;
    }
    double least = std::numeric_limits<double>::infinity();
};

void expect_bullet(const Body& first, const Body& second, double expected) {
    btDefaultCollisionConfiguration configuration;
    btCollisionDispatcher dispatcher(&configuration);
    btDbvtBroadphase broadphase;
    btCollisionWorld world(&dispatcher, &broadphase, &configuration);
    BulletLink a(first), b(second);
    world.addCollisionObject(&a.object);
    world.addCollisionObject(&b.object);
    LeastDistance result;
    world.contactPairTest(&a.object, &b.object, result);
    EXPECT_NEAR(result.least, expected, rounding) << first.link << ", " << second.link;
    world.removeCollisionObject(&a.object);
    world.removeCollisionObject(&b.object);
}

TEST(CollisionLibraries, FindTheDistancesOfTheModel) {
    const SphereModel model = spheres_on(panda());
    const urdf::ModelInterfaceSharedPtr robot = urdf::parseURDF(urdf_of(model));
    ASSERT_TRUE(robot);
    const Kinematics kinematics(model.robot);
    int touching = 0, apart = 0;
    for (const std::vector<double>& configuration : configurations(kinematics)) {
        const std::vector<Body> bodies = bodies_of(*robot, joint_values(kinematics, configuration));
        const Placed expected = placed(model, kinematics, configuration);
        ASSERT_EQ(bodies.size(), expected.size());
        for (std::size_t a = 0; a < bodies.size(); ++a) {
            for (std::size_t b = a + 1; b < bodies.size(); ++b) {
                const double least = least_distance(expected.at(bodies[a].link), expected.at(bodies[b].link));
                ++(least <= 0 ? touching : apart);
                expect_fcl(bodies[a], bodies[b], least);
                expect_bullet(bodies[a], bodies[b], least);
            }
        }
    }
    EXPECT_GT(touching, 20);
    EXPECT_GT(apart, 20);
}

} // namespace
} // namespace foam::test
