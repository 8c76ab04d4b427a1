// Voids of unions of elements, whose answer is known.
#include <foam/geometry/internal/proof.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace foam {
namespace {

using Kind = Element::Kind;

// Capsules along the edges of a tetrahedron leave four windows; triangles on its faces close them.
TEST(Nerve, WindowsAreNoWalls) {
    const std::array<Vec3, 4> corners{Vec3{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
    for (const std::size_t closed : {0UL, 1UL, 2UL, 3UL, 4UL}) {
        std::vector<Element> elements;
        for (std::size_t a = 0; a < 4; ++a) {
            for (std::size_t b = 0; b < a; ++b) {
                Element e = Element::capsule(0.1, distance(corners[a], corners[b]));
                const Vec3 along = normalized(corners[b] - corners[a]), axis = cross({0, 0, 1}, along);
                e.pose = Pose::from_axis_angle(normalized(axis), std::atan2(norm(axis), along.z));
                e.pose.translation = (corners[a] + corners[b]) * 0.5;
                elements.push_back(e);
            }
        }
        for (std::size_t face = 0; face < closed; ++face) {
            std::vector<Vec3> points;
            for (std::size_t k = 0; k < 4; ++k) {
                if (k != face) {
                    points.push_back(corners[k] * 1.01 - corners[face] * 0.01);
                    points.push_back(corners[k] * 1.02 - corners[face] * 0.02);
                }
            }
            elements.push_back({.kind = Kind::hull, .hull = convex_hull(points)});
        }
        EXPECT_EQ(has_no_void(elements), closed != 4) << closed;
    }
}

// Boxes on the surface of a cube leave a void inside, unless one is left out. A ring of them has none.
TEST(Nerve, TellsVoidsFromTunnels) {
    for (const bool hole : {false, true}) {
        std::vector<Element> shell, ring;
        for (int x = -3; x <= 3; ++x) {
            for (int y = -3; y <= 3; ++y) {
                for (int z = -3; z <= 3; ++z) {
                    const bool surface = std::max({std::abs(x), std::abs(y), std::abs(z)}) == 3;
                    Element box = Element::box({1.01, 1.01, 1.01});
                    box.pose.translation = {1.0 * x, 1.0 * y, 1.0 * z};
                    if (surface && !(hole && x == 0 && y == 0 && z == 3)) {
                        shell.push_back(box);
                    }
                    if (z == 0 && surface) {
                        ring.push_back(box);
                    }
                }
            }
        }
        EXPECT_EQ(has_no_void(shell), hole);
        EXPECT_TRUE(has_no_void(ring));
    }
}

// Whether boxes that share a face to the last digit meet is in doubt: nothing is proved then.
TEST(Nerve, ATouchIsNoProof) {
    std::vector<Element> slabs;
    for (int axis = 0; axis < 3; ++axis) {
        for (const double side : {-1.0, 1.0}) {
            Vec3 size{3, 3, 3}, center{};
            size[axis] = 1;
            center[axis] = side;
            for (int before = 0; before < axis; ++before) {
                size[before] = 1;
            }
            Element slab = Element::box(size);
            slab.pose.translation = center;
            slabs.push_back(slab);
        }
    }
    EXPECT_FALSE(has_no_void(slabs)) << "a cube of 1 is left in the middle";
}

TEST(Nerve, TooManySetsAreInDoubt) {
    std::vector<Element> one_place;
    for (int k = 0; k < 64; ++k) {
        one_place.push_back(Element::capsule(1 + 0.01 * k, 1));
    }
    EXPECT_FALSE(has_no_void(one_place));
    one_place.resize(20);
    EXPECT_TRUE(has_no_void(one_place));
}

} // namespace
} // namespace foam
