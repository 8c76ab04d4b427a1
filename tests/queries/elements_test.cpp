// Elements as shapes of collision libraries; near pairs of them.
#include "bench/src/queries/elements.hpp"

#include <foam/collision/separation.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace foam {
namespace {

Element element(Element::Kind kind) {
    Element result;
    result.kind = kind;
    result.pose = Pose::from_xyz_rpy({0.5, -0.2, 0.1}, {0.3, -0.4, 1});
    switch (kind) {
    case Element::Kind::sphere:
        result.radius = 0.1;
        break;
    case Element::Kind::capsule:
    case Element::Kind::cylinder:
        result.radius = 0.05;
        result.half.z = 0.1;
        break;
    case Element::Kind::box:
        result.half = {0.05, 0.1, 0.15};
        break;
    case Element::Kind::swept_box:
        result.half = {0.05, 0.1, 0.02};
        result.radius = 0.03;
        break;
    case Element::Kind::hull: {
        const std::vector<Vec3> corners{{0, 0, 0}, {0.1, 0, 0}, {0, 0.2, 0}, {0.05, 0.05, 0.3}, {0.1, 0.1, 0.1}};
        result.hull = convex_hull(corners);
        break;
    }
    }
    return result;
}

/// A link with an element of each kind but the sphere, and one with a sphere.
std::vector<LinkSpheres> links_of(Element::Kind kind) {
    if (kind == Element::Kind::sphere) {
        return {{"a", {{{0, 0, 0}, 0.1}, {{0.3, 0, 0}, 0.2}}}};
    }
    return {{"a", {{}, {element(kind)}}}};
}

class EveryKind : public testing::TestWithParam<Element::Kind> {};

TEST_P(EveryKind, ShapesHoldTheElement) {
    const Element given = element(GetParam());
    const EngineShape shape = body_of(Elements(std::span(&given, 1))).at(0);
    EXPECT_EQ(shape.convex, given.kind == Element::Kind::swept_box || given.kind == Element::Kind::hull);
    Box box;
    if (const auto* mesh = std::get_if<std::shared_ptr<const Mesh>>(&shape.geometry)) {
        for (const Vec3& vertex : (*mesh)->vertices) {
            box.add(shape.pose * vertex);
        }
    } else {
        for (const Vec3& vertex : enclosing_mesh(std::get<Element>(shape.geometry)).vertices) {
            box.add(shape.pose * vertex);
        }
    }
    const Box exact = bounds(given);
    const double room = given.kind == Element::Kind::box || given.kind == Element::Kind::hull ? 1e-12 : 0.02;
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(box.low[axis], exact.low[axis], room);
        EXPECT_NEAR(box.high[axis], exact.high[axis], room);
    }
}

TEST_P(EveryKind, LibrariesFindNearPairsApartAndMovedOnesTouching) {
    Random random(1);
    const NearPairs near(links_of(GetParam()), 5, random);
    ASSERT_EQ(near.robot().bodies.size(), 10u);
    ASSERT_EQ(near.robot().pairs.size(), 5u);
    EngineProblem problem;
    problem.models = {near.robot(), near.robot()};
    problem.environments = {{}};
    for (int round = 0; round < 20; ++round) {
        const std::vector<Pose> apart = near.poses(random);
        std::vector<Pose> touching = apart;
        touching[7].translation = touching[6].translation; // centre on centre
        problem.queries.push_back({0, false, apart, 3});
        problem.queries.push_back({0, false, touching, 3});
    }
    for (const EngineName& engine : engine_names()) {
        if (!std::filesystem::exists(engine_program(engine))) {
            continue;
        }
        problem.engine = engine.name;
        const EngineReport report = ask_engine(problem);
        ASSERT_EQ(report.error, "");
        for (std::size_t q = 0; q < report.answers.size(); ++q) {
            for (const EngineAnswer& answer : report.answers[q]) {
                EXPECT_EQ(answer.hits_itself, q % 2 == 1) << engine.name;
                EXPECT_FALSE(answer.hits_obstacle);
                EXPECT_GT(answer.collision_seconds, 0);
                EXPECT_GT(answer.move_seconds, 0);
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(All, EveryKind,
                         testing::Values(Element::Kind::sphere, Element::Kind::capsule, Element::Kind::cylinder,
                                         Element::Kind::box, Element::Kind::swept_box, Element::Kind::hull),
                         [](const auto& kind) { return std::string(to_string(kind.param)); });

TEST(NearPairs, DependOnTheSeedAlone) {
    const auto poses = [](std::uint64_t seed) {
        Random random(seed);
        const NearPairs near(links_of(Element::Kind::box), 3, random);
        return near.poses(random);
    };
    EXPECT_EQ(poses(4), poses(4));
    EXPECT_NE(poses(4), poses(5));
}

TEST(ElementRobot, NeighboursAreNoPairs) {
    auto robot = std::make_shared<Robot>();
    robot->root = "a";
    for (const char* name : {"a", "b", "c", "bare"}) {
        robot->links.push_back({name, {}, {}});
    }
    for (const auto& [parent, child] : {std::pair{"a", "b"}, {"b", "c"}, {"c", "bare"}}) {
        Joint joint;
        joint.name = child;
        joint.kind = Joint::Kind::continuous;
        joint.parent = parent;
        joint.child = child;
        robot->joints.push_back(joint);
    }
    const Kinematics kinematics(robot);
    const std::vector<LinkSpheres> links{{"a", {{{}, 1}}}, {"b", {{{}, 1}}}, {"c", {{{}, 1}, {{2, 0, 0}, 1}}}};
    const ElementRobot result = element_robot(kinematics, links);
    EXPECT_THAT(result.links, testing::ElementsAre(0, 1, 2));
    ASSERT_EQ(result.robot.pairs.size(), 1u);
    EXPECT_EQ(result.robot.pairs[0], (std::array<std::uint32_t, 2>{0, 2}));
    EXPECT_EQ(shape_pairs(result.robot), 2u);
}

} // namespace
} // namespace foam
