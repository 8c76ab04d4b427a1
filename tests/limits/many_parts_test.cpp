// A solid of very many parts answers as its parts do, and a link of ten thousand elements is a matter of a second.
#include "support/runs.hpp"
#include "support/sanitizers.hpp"

#include <foam/base/random.hpp>
#include <foam/geometry/internal/solids.hpp>
#include <foam/geometry/solid.hpp>

#include <fmt/format.h>
#include <gmock/gmock.h>

namespace foam {
namespace {

Mesh tetrahedron(const Vec3& at, double size) {
    Mesh mesh;
    mesh.vertices = {at, at + Vec3{size, 0, 0}, at + Vec3{0, size, 0}, at + Vec3{0, 0, size}};
    mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    return mesh;
}

/// Boxes, balls, tetrahedra with and without a hole, some of which overlap.
std::vector<Solid::Part> mixed_parts(std::size_t count) {
    Random random(7);
    std::vector<Solid::Part> parts;
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3 at{random.uniform(), random.uniform(), random.uniform()};
        const double size = 0.05 + 0.2 * random.uniform();
        Solid::Part part;
        if (i % 4 == 0) {
            part.primitive = Element::box({size, size, size});
            part.pose.translation = at;
        } else if (i % 4 == 1) {
            part.primitive = Element::sphere(size / 2);
            part.pose.translation = at;
        } else {
            Mesh mesh = tetrahedron(at, size);
            if (i % 4 == 3) {
                mesh.triangles.pop_back();
            }
            part.mesh = std::make_shared<const Mesh>(std::move(mesh));
        }
        parts.push_back(std::move(part));
    }
    return parts;
}

TEST(ManyParts, AnswerAsEachOfThem) {
    const std::vector<Solid::Part> parts = mixed_parts(200); // several times as many as get an index
    const auto all = Solid::make(parts);
    std::vector<std::shared_ptr<const Solid>> each;
    for (const Solid::Part& part : parts) {
        each.push_back(Solid::make(std::vector<Solid::Part>{part}));
    }
    Random random(8);
    int inside = 0;
    for (int i = 0; i < 500; ++i) {
        const Vec3 p{1.4 * random.uniform() - 0.2, 1.4 * random.uniform() - 0.2, 1.4 * random.uniform() - 0.2};
        bool contains = false;
        double signed_distance = 1e300, nearest = 1e300;
        for (const auto& one : each) {
            contains = contains || one->contains(p);
            signed_distance = std::min(signed_distance, one->signed_distance(p));
            nearest = std::min(nearest, distance(one->closest(p).point, p));
        }
        inside += contains;
        EXPECT_EQ(all->contains(p), contains);
        EXPECT_EQ(all->signed_distance(p), signed_distance);
        EXPECT_EQ(distance(all->closest(p).point, p), nearest);
        double length = 0;
        const Vec3 direction = normalized(Vec3{random.uniform() - 0.5, random.uniform() - 0.5, 0.5});
        for (const auto& [enter, leave] : all->inside_along(p, direction)) {
            length += leave - enter;
        }
        double longest = 0, sum = 0; // the union of all is between these
        for (const auto& one : each) {
            for (const auto& [enter, leave] : one->inside_along(p, direction)) {
                longest = std::max(longest, leave - enter);
                sum += leave - enter;
            }
        }
        EXPECT_GE(length, longest * (1 - 1e-12));
        EXPECT_LE(length, sum * (1 + 1e-12));
    }
    EXPECT_GT(inside, 10);
}

TEST(ManyParts, VolumesAddUpWhereTheyDoNotOverlap) {
    std::vector<Solid::Part> parts;
    for (int i = 0; i < 1000; ++i) {
        Solid::Part part;
        part.primitive = Element::box({0.5, 0.5, 0.5});
        part.pose.translation = {static_cast<double>(i % 10), static_cast<double>(i / 10 % 10), i / 100.0};
        part.pose.translation.z = i / 100;
        parts.push_back(part);
    }
    const auto boxes = Solid::make(parts);
    EXPECT_NEAR(boxes->volume(), 125, 1e-9);
    EXPECT_EQ(boxes->volume_error(), 0);
    for (Solid::Part& part : parts) {
        const Mesh box = enclosing_mesh(*part.primitive);
        part.mesh = std::make_shared<const Mesh>(transformed(box, part.pose));
        part.primitive.reset();
    }
    EXPECT_NEAR(Solid::make(parts)->volume(), 125, 1e-9);
}

TEST(Cavities, AreShellsThatAreWoundInwards) {
    Mesh hollow = tetrahedron({0, 0, 0}, 1);
    EXPECT_EQ(geometry::cavity_volume(*Solid::make(hollow)), 0);
    Mesh inner = tetrahedron({0.1, 0.1, 0.1}, 0.3);
    for (Triangle& t : inner.triangles) {
        std::swap(t[1], t[2]);
    }
    append(hollow, inner);
    EXPECT_NEAR(geometry::cavity_volume(*Solid::make(hollow)), 0.027 / 6, 1e-12);
    hollow.triangles.pop_back(); // a hole that matters
    EXPECT_EQ(geometry::cavity_volume(*Solid::make(hollow)), 0);
}

class ManyElements : public test::RunTest {};

/// A grid of ten thousand small boxes in one link: when it took a hundred times as long for ten times as many, this
/// took minutes. A hundred thousand take some ten times as long.
TEST_F(ManyElements, OfOneLinkBecomeSpheres) {
    for (const std::string shape : {"<box size='0.008 0.008 0.008'/>", "<mesh filename='small.obj'/>"}) {
        std::string urdf = "<?xml version=\"1.0\"?><robot name=\"many\"><link name=\"base\">";
        for (int i = 0; i < 10'000; ++i) {
            urdf += fmt::format("<collision><origin xyz=\"{} {} {}\"/><geometry>{}</geometry></collision>\n",
                                0.01 * (i % 22), 0.01 * (i / 22 % 22), 0.01 * (i / 484), shape);
        }
        write("many.urdf", urdf + "</link></robot>");
        write("small.obj", "v 0 0 0\nv 0.008 0 0\nv 0 0.008 0\nv 0 0 0.008\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
        RunOptions limited = options();
        if (!test::sanitized) {
            limited.time_limit = 120;
        }
        const RunResult result = run(
            recipe_of("name: many\nrobot: {urdf: many.urdf}\nstages: [spherize.cover: {effort: fast}]\nbudget: {spheres: "
                      "8}\n"),
            registry, limited);
        EXPECT_EQ(result.cut, Cut::none);
        EXPECT_TRUE(result.certified);
        EXPECT_EQ(result.total.spheres, 8u);
    }
}

} // namespace
} // namespace foam
