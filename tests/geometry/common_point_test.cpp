// Points that elements have in common, against local search, and elements that nearly touch.
#include "geometry/src/proof/common_point.hpp"
#include "some_elements.hpp"

#include <foam/base/random.hpp>
#include <foam/geometry/measure.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>

namespace foam::geometry {
namespace {

using Kind = Element::Kind;
using test::random_direction;
using test::random_pose;

constexpr std::array kinds{Kind::sphere,    Kind::capsule, Kind::box,      Kind::cylinder,
                           Kind::swept_box, Kind::hull,    Kind::ellipsoid};

struct Bodied {
    Elements all;
    std::vector<Element> elements{all.begin(), all.end()};
    Bodies bodies{all, {}, 20, test::most_halvings};
    Walls walls{elements, bodies};

    explicit Bodied(std::vector<Element> e) : all(std::move(e)) {}
    Meeting find(Vec3& point) const {
        std::vector<std::uint32_t> each(elements.size());
        std::iota(each.begin(), each.end(), 0);
        return CommonPoint(bodies, walls).find(each, point);
    }
};

/// Returns about the least of the largest distances of a point from elements.
double least_of_farthest(const std::vector<Element>& elements, Random& random) {
    const auto farthest = [&](const Vec3& p) {
        double most = -std::numeric_limits<double>::infinity();
        for (const Element& e : elements) {
            most = std::max(most, signed_distance(e, p));
        }
        return most;
    };
    double least = std::numeric_limits<double>::infinity();
    for (int start = 0; start < 4; ++start) {
        Vec3 at = bounds(elements[static_cast<std::size_t>(start) % elements.size()]).center();
        double here = farthest(at);
        for (double step = 1; step > 1e-6;) {
            bool better = false;
            for (int k = 0; k < 12 && !better; ++k) {
                const Vec3 next = at + random_direction(random) * step;
                const double there = farthest(next);
                better = there < here;
                if (better) {
                    at = next;
                    here = there;
                }
            }
            step = better ? step : step / 2;
        }
        least = std::min(least, here);
    }
    return least;
}

TEST(CommonPoint, IsInAllElementsOrThereIsNone) {
    Random random(11);
    int common = 0, none = 0;
    for (int round = 0; round < 600; ++round) {
        std::vector<Element> elements;
        const std::size_t count = 2 + static_cast<std::size_t>(round) % 3;
        for (std::size_t k = 0; k < count; ++k) {
            elements.push_back(test::some_element(kinds[random.below(kinds.size())], random));
        }
        const Bodied bodied(elements);
        Vec3 point{};
        const Meeting meeting = bodied.find(point);
        ASSERT_NE(meeting, Meeting::doubt) << round;
        if (meeting == Meeting::common) {
            ++common;
            for (const Element& e : elements) {
                EXPECT_LE(signed_distance(e, point), 0) << round;
            }
        } else {
            ++none;
            EXPECT_GT(least_of_farthest(elements, random), 0) << round;
        }
    }
    EXPECT_GT(common, 60);
    EXPECT_GT(none, 60);
}

// Balls about the corners of a regular simplex of 2, 3 or 4 corners, at a distance of 1 from its middle.
TEST(CommonPoint, OfElementsThatNearlyTouch) {
    const std::array<std::vector<Vec3>, 3> simplices{
        std::vector<Vec3>{{1, 0, 0}, {-1, 0, 0}},
        std::vector<Vec3>{{1, 0, 0}, {-0.5, std::sqrt(0.75), 0}, {-0.5, -std::sqrt(0.75), 0}},
        std::vector<Vec3>{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}};
    Random random(3);
    for (const std::vector<Vec3>& corners : simplices) {
        for (const double hair : {1e-2, 1e-4, 1e-6, 1e-8, 1e-10}) {
            const Pose pose = random_pose(random, 3);
            for (const double side : {-1.0, 1.0}) {
                std::vector<Element> balls;
                for (const Vec3& c : corners) {
                    balls.push_back(Element::sphere(1 + side * hair));
                    balls.back().pose.translation = pose * normalized(c);
                }
                Vec3 point = pose * Vec3{0.3, 0.1, -0.2};
                const Meeting meeting = Bodied(balls).find(point);
                const Meeting wanted = side > 0 ? Meeting::common : Meeting::none;
                // A hair below the rounding of squares may be in doubt, but no answer is wrong.
                EXPECT_TRUE(meeting == wanted || (hair < 1e-9 && meeting == Meeting::doubt))
                    << corners.size() << " balls, " << side * hair;
            }
        }
    }
}

TEST(CommonPoint, OfBoxesThatShareAFace) {
    Random random(5);
    for (const double hair : {1e-3, 1e-6, 1e-9}) {
        const Pose pose = random_pose(random, 3);
        for (const double side : {-1.0, 1.0}) {
            std::vector<Element> boxes(2, Element::box({2, 3, 1}));
            boxes[0].pose = boxes[1].pose = pose;
            boxes[1].pose.translation = pose * Vec3{2 - side * hair, 0.4, 0.2};
            Vec3 point{};
            EXPECT_EQ(Bodied(boxes).find(point), side > 0 ? Meeting::common : Meeting::none) << side * hair;
        }
    }
}

} // namespace
} // namespace foam::geometry
