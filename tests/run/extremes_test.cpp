// Geometry of extreme size, place and form through whole runs: a proof or a clear error, in bounded time.
#include "support/runs.hpp"

#include <foam/base/error.hpp>
#include <foam/geometry/measure.hpp>
#include <foam/runtime/contract.hpp>
#include <foam/runtime/internal/cover.hpp>
#include <foam/search/cover.hpp>
#include <foam/search/spherize.hpp>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <atomic>

namespace foam {
namespace {

using ::testing::HasSubstr;

Mesh box_with_corner(const Vec3& corner) {
    Mesh mesh = sample::box({1, 1, 1});
    mesh.vertices[7] = corner;
    return mesh;
}

Mesh cube(double edge, const Vec3& center = {}) {
    return sample::box({edge, edge, edge}, center);
}

std::string obj_of(const Mesh& mesh) {
    std::string text;
    for (const Vec3& v : mesh.vertices) {
        text += fmt::format("v {} {} {}\n", v.x, v.y, v.z);
    }
    for (const Triangle& t : mesh.triangles) {
        text += fmt::format("f {} {} {}\n", t[0] + 1, t[1] + 1, t[2] + 1);
    }
    return text;
}

class Extremes : public test::RunTest {
protected:
    struct Outcome {
        bool certified = false;
        double excess_volume = 0;
        std::string error; ///< empty if the run succeeded
        ErrorCode code = ErrorCode::internal;
    };

    /// Counts the tasks of stages that are no loaders.
    struct Begun final : Observer {
        void on(const Event& event) override {
            tasks += event.kind == Event::Kind::task_started && !event.stage.starts_with("load.");
        }
        std::atomic<int> tasks = 0;
    };

    Outcome outcome(const std::string& recipe) {
        Outcome result;
        begun.tasks = 0;
        try {
            RunOptions observed = options();
            observed.observer = &begun;
            const RunResult made = run(recipe_of(recipe), registry, observed);
            result.certified = made.certified;
            result.excess_volume = made.total.excess_volume;
        } catch (const Error& error) {
            result.error = error.what();
            result.code = error.code();
        }
        return result;
    }
    Outcome outcome_of(const Mesh& mesh, const std::string& stages) {
        write("part.obj", obj_of(mesh));
        return outcome("name: x\nmesh: part.obj\nstages: [" + stages + "]\nbudget: {spheres: 6}\n");
    }
    Begun begun;

    std::vector<std::string> stages_of(StageKind kind) const {
        std::vector<std::string> names;
        for (const auto& [name, stage] : registry.stages()) {
            if (stage.kind == kind) {
                names.push_back(name);
            }
        }
        return names;
    }
    /// Of a robot with one link.
    Outcome outcome_of_geometry(const std::string& geometry, const std::string& origin = "") {
        write("one.urdf", "<robot name=\"one\">\n<link name=\"arm\">\n<collision>" + origin + "<geometry>" + geometry +
                              "</geometry></collision></link></robot>\n");
        return outcome("name: x\nrobot: {urdf: one.urdf}\nstages: [spherize.octree]\nbudget: {spheres: 2}\n");
    }
};

/// Within the bounds, but hard: what spherizers and filters must live with.
std::map<std::string, Mesh> legal_meshes() {
    return {
        {"spike to 1e6 m", box_with_corner({1e6, 1e6, 1e6})},
        {"spike to 5e8 m", box_with_corner({5e8, 5e8, 5e8})},
        {"spike to 1e6 m along an edge", box_with_corner({1e6, 0.5, 0.5})},
        {"corner at 1e-80 m", box_with_corner({1e-80, 1e-80, 1e-80})},
        {"corner at 1e-320 m", box_with_corner({1e-320, 1e-320, 1e-320})},
        {"cube of 1e-12 m", cube(1e-12)},
        {"cube of 5e8 m", cube(5e8)},
        {"cube 1e8 m away", cube(1, {1e8, 1e8, -1e8})},
        {"small cube far away", cube(1e-6, {100, 0, 0})},
        {"sliver", sample::box({1, 1, 1e-9})},
        {"needle", sample::box({1, 1e-9, 1e-9})},
        {"needle of 1e-5", sample::box({1, 1e-5, 1e-5})},
        {"sliver far away", sample::box({1e-6, 1, 1}, {1e6, 0, 0})},
        {"flat", sample::box({1, 1, 0})},
        {"line", sample::box({1, 0, 0})},
    };
}

// All of them, on all: that takes its time.
TEST_F(Extremes, EverySpherizerCoversWhatIsWithinBounds) {
    for (const auto& [name, mesh] : legal_meshes()) {
        const Sphere around = minimum_enclosing_sphere(mesh.vertices);
        const double bounding = 4.0 / 3 * 3.141593 * around.radius * around.radius * around.radius;
        for (const std::string& spherizer : stages_of(StageKind::spherizer)) {
            const Outcome made = outcome_of(mesh, spherizer);
            EXPECT_TRUE(made.certified) << name << ", " << spherizer << ": " << made.error;
            EXPECT_LE(made.excess_volume, 1.001 * bounding) << name << ", " << spherizer;
        }
    }
}

TEST_F(Extremes, ACapsuleAroundABallComesBackAsACapsule) {
    write("one.urdf", "<robot name=\"one\"><link name=\"ball\"><collision><geometry><sphere radius=\"0.1\"/></geometry>"
                      "</collision></link></robot>\n");
    const Outcome made =
        outcome("name: x\nrobot: {urdf: one.urdf}\nstages: [approximate.capsules]\nbudget: {elements: 1}\n"
                "outputs: [write.urdf: {file: x.urdf}, write.json: {file: x.json}]\n");
    EXPECT_TRUE(made.certified) << made.error;
}

TEST_F(Extremes, EveryFilterTakesOrRefusesWhatIsWithinBounds) {
    for (const auto& [name, mesh] : legal_meshes()) {
        for (const std::string& filter : stages_of(StageKind::mesh_filter)) {
            const Outcome made = outcome_of(mesh, filter + ", spherize.octree");
            EXPECT_TRUE(made.certified || made.code == ErrorCode::geometry)
                << name << ", " << filter << ": " << made.error;
            EXPECT_EQ(made.error.find("std::"), std::string::npos) << made.error;
            EXPECT_EQ(made.error.find("contract"), std::string::npos) << made.error;
        }
    }
}

TEST_F(Extremes, SpikesAndNeedlesAreSoundAsTheyAre) {
    for (const Mesh& mesh : {box_with_corner({1e6, 1e6, 1e6}), box_with_corner({1e6, 0.5, 0.5}),
                             sample::box({1, 1e-7, 1e-7}), sample::box({1e6, 1, 1e-2})}) {
        const Outcome made = outcome_of(mesh, "repair.soup, spherize.octree");
        EXPECT_TRUE(made.certified) << made.error;
    }
}

TEST_F(Extremes, WhatIsBeyondTheBoundsIsRefusedBeforeAnyStage) {
    const std::map<std::string, std::pair<Mesh, std::string>> beyond{
        {"edge 1e120", {cube(1e120), "its size is 1.73e+120 m, more than the 1e+09 m"}},
        {"edge 1e150", {cube(1e150), "its size is 1.73e+150 m, more than the 1e+09 m"}},
        {"edge 1e155", {cube(1e155), "its size is 1.73e+155 m, more than the 1e+09 m"}},
        {"edge 1e300", {cube(1e300), "its size is 1.73e+300 m, more than the 1e+09 m"}},
        {"edge 1e-13", {cube(1e-13), "its size is 1.73e-13 m, less than the 1e-12 m"}},
        {"edge 1e-320", {cube(1e-320), "its size is 1.73e-320 m, less than the 1e-12 m"}},
        {"spike to 1e75", {box_with_corner({1e75, 1e75, 1e75}), "its size is 1.73e+75 m, more than the 1e+09 m"}},
        {"at 1e10",
         {cube(1, {1e10, 0, 0}), "it is 1e+10 m from the origin of its frame, more than 1e+09 times its size"}},
        {"at 1e300", {cube(1, {1e300, 1e300, 1e300}), "all of its points are one point"}},
        {"a point", {cube(0, {1, 2, 3}), "all of its points are one point"}},
    };
    std::vector<std::string> chains = stages_of(StageKind::spherizer);
    for (const std::string& filter : stages_of(StageKind::mesh_filter)) {
        chains.push_back(filter + ", spherize.octree");
    }
    for (const auto& [name, expected] : beyond) {
        for (const std::string& chain : chains) {
            const Outcome made = outcome_of(expected.first, chain);
            EXPECT_THAT(made.error, HasSubstr("link 'part': ")) << name << ", " << chain;
            EXPECT_THAT(made.error, HasSubstr(expected.second)) << name << ", " << chain;
            EXPECT_THAT(made.error, HasSubstr("remedy: ")) << name << ", " << chain;
            EXPECT_EQ(made.code, ErrorCode::input) << name << ", " << chain;
            EXPECT_EQ(begun.tasks, 0) << name << ", " << chain;
        }
    }
}

TEST_F(Extremes, NoSphereStandsInForWhatIsRefused) {
    write("part.obj", obj_of(cube(1e150)));
    for (const std::string on_error : {"skip", "fallback"}) {
        const Outcome made =
            outcome("name: x\nmesh: part.obj\nstages: [spherize.octree]\non_error: " + on_error + "\n");
        EXPECT_FALSE(made.certified) << on_error;
    }
}

TEST_F(Extremes, PrimitivesAreRefusedWithLinkAndElement) {
    for (const std::string number : {"1e-320", "1e-200", "1e-13", "1e10", "1e120", "1e155", "1e308"}) {
        for (const std::string& geometry :
             {"<box size=\"" + number + " " + number + " " + number + "\"/>", "<sphere radius=\"" + number + "\"/>",
              "<cylinder radius=\"" + number + "\" length=\"" + number + "\"/>"}) {
            const Outcome made = outcome_of_geometry(geometry);
            EXPECT_THAT(made.error, HasSubstr("link 'arm': ")) << geometry;
            EXPECT_THAT(made.error, HasSubstr("one.urdf:3: ")) << geometry;
            EXPECT_THAT(made.error, HasSubstr("its size is ")) << geometry;
            EXPECT_EQ(made.error.find("nan"), std::string::npos) << made.error;
        }
    }
    for (const std::string at : {"1e10", "1e120", "1e300"}) {
        const Outcome made = outcome_of_geometry("<sphere radius=\"1\"/>", "<origin xyz=\"" + at + " 0 0\"/>");
        EXPECT_THAT(made.error, HasSubstr("one.urdf:3: sphere: it is " + std::string("1e+")));
    }
    for (const std::string thin :
         {"<cylinder radius=\"1e-320\" length=\"1\"/>", "<cylinder radius=\"1\" length=\"1e-200\"/>",
          "<box size=\"1 1 1e-9\"/>", "<box size=\"1 1e-9 1e-9\"/>"}) {
        const Outcome made = outcome_of_geometry(thin);
        EXPECT_TRUE(made.certified) << thin << ": " << made.error;
    }
    EXPECT_TRUE(
        outcome_of_geometry("<box size=\"1 1 1\"/>", "<origin xyz=\"1e8 0 0\" rpy=\"1e308 1e300 -1e200\"/>").certified);
}

TEST_F(Extremes, ScalesOfMeshesAreRefusedWithLinkAndFile) {
    write("part.obj", obj_of(cube(1)));
    for (const std::string scale : {"1e200 1e200 1e200", "1e-200 1e-200 1e-200", "1e200 1 1", "1e308 1e308 1e308"}) {
        const Outcome made = outcome_of_geometry("<mesh filename=\"part.obj\" scale=\"" + scale + "\"/>");
        EXPECT_THAT(made.error, HasSubstr("link 'arm': ")) << scale;
        EXPECT_THAT(made.error, HasSubstr("part.obj: its size is ")) << scale;
    }
    EXPECT_TRUE(outcome_of_geometry("<mesh filename=\"part.obj\" scale=\"-1 -1 -1\"/>").certified);
}

TEST_F(Extremes, SizeAndPlaceChangeNothingInTheResult) {
    const double at_one = outcome_of(sample::bracket(), "spherize.cover").excess_volume;
    for (const int exponent : {-30, 30}) {
        const double scale = std::ldexp(1.0, exponent);
        const double scaled =
            outcome_of(transformed(sample::bracket(), {}, {scale, scale, scale}), "spherize.cover").excess_volume;
        EXPECT_NEAR(scaled / std::pow(scale, 3), at_one, 0.1 * at_one) << exponent;
    }
    Pose far;
    far.translation = {1e5, 0, 0};
    EXPECT_NEAR(outcome_of(transformed(sample::bracket(), far), "spherize.cover").excess_volume, at_one, 0.1 * at_one);
}

TEST_F(Extremes, BudgetsStayMetres) {
    write("part.obj", obj_of(cube(1e-7)));
    const RunResult near = run(recipe_of("name: x\nmesh: part.obj\nstages: [spherize.octree]\n"
                                         "budget: {spheres: 64, max_protrusion: 2.0e-8}\n"),
                               registry, options("octree"));
    EXPECT_GT(near.total.spheres, 1u);
    EXPECT_LE(near.total.protrusion_max, 2.1e-8);
}

TEST_F(Extremes, FiguresOfStagesStayMetres) {
    const auto move = [&](double edge) {
        write("part.obj", obj_of(cube(edge)));
        const RunResult made =
            run(recipe_of(
                    "name: x\nmesh: part.obj\nstages: [smooth.laplacian: {volume_tolerance: 1000}, spherize.octree]\n"),
                registry, options(fmt::format("edge {}", edge)));
        for (const StageReport& stage : made.links.at(0).stages) {
            for (const auto& metric : stage.metrics) {
                if (metric.name == "largest_move") {
                    return metric.value;
                }
            }
        }
        return -1.0;
    };
    EXPECT_GT(move(1), 0);
    EXPECT_EQ(move(std::ldexp(1.0, 25)), std::ldexp(move(1), 25));
    EXPECT_EQ(move(std::ldexp(1.0, -35)), std::ldexp(move(1), -35));
}

TEST_F(Extremes, AProgramsSolidsAreTreatedAlike) {
    for (const double edge : {1e-11, 1e8}) {
        const auto solid = Solid::make(cube(edge, {100 * edge, 0, 1e5 * edge}));
        for (const Effort effort : {Effort::fast, Effort::normal}) {
            CoverOptions options;
            options.effort = effort;
            const SphereCover cover = spherize(*solid, 4, options);
            EXPECT_TRUE(certify(*solid, cover.spheres).holds);
            EXPECT_TRUE(cover.certificate.holds);
            EXPECT_LT(cover.volume, 4 * edge * edge * edge);
        }
    }
    for (const Mesh& mesh : {cube(1e130), cube(1e-20), cube(1, {1e12, 0, 0})}) {
        EXPECT_THROW(spherize(mesh, 4), Error);
    }
}

/// Where elements only just overlap, a proof depends on their last digits. Curved primitives are proved by halving
/// alone, and show it.
TEST_F(Extremes, ElementsThatOnlyJustOverlapAreProved) {
    for (const auto& [shape, elements] : {std::pair{"capsule radius='0.1' length='0.3'", "boxes"},
                                          {"cylinder radius='0.2' length='0.1'", "boxes"},
                                          {"sphere radius='0.1'", "cylinders"}}) {
        write("robot.urdf", fmt::format("<robot name='r'><link name='a'><collision><geometry><{}/></geometry>"
                                        "</collision></link></robot>",
                                        shape));
        for (const int count : {2, 4, 6}) {
            const std::string text = fmt::format("robot: {{urdf: robot.urdf}}\nstages: [approximate.{}]\n"
                                                 "budget: {{elements: {}}}\noutputs: [write.json]\n",
                                                 elements, count);
            EXPECT_TRUE(run(recipe_of(text), registry, options()).certified) << text;
        }
    }
}

/// Boxes whose rounded numbers were not proved, before they were grown until they are.
TEST(ExtremesOfNumbers, BoxesThatOverlapByAMillionthAreProved) {
    const auto solid = Solid::make(std::vector<Solid::Part>{
        {nullptr, Element::capsule(0.1, 0.3), Pose{}}});
    CoverSearch search(*solid, {.kinds = {Element::Kind::box}});
    for (const std::size_t count : {2, 3, 4, 5, 6, 7, 8}) {
        SphereTree tree;
        tree.levels.push_back({search.cover(count).elements});
        const double less = (3e-4 - 1e-6) * solid->bounds().diagonal(); // of the overlap
        for (Element& box : tree.levels.back().elements.shaped()) {
            box.half -= Vec3{less, less, less};
        }
        const runtime::FinishedTree finished = runtime::finished_tree(*solid, std::move(tree), Guarantee::outer);
        EXPECT_TRUE(certify(*solid, finished.tree.levels.back().elements).holds) << count;
    }
}

} // namespace
} // namespace foam
