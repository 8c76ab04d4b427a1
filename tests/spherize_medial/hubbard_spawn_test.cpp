// What spherize.hubbard and spherize.spawn promise beyond the contract of all spherizers.
#include "fixture.hpp"

#include <gtest/gtest.h>

using namespace foam;
using namespace foam::test;

namespace {

class HubbardAndSpawn : public testing::TestWithParam<std::string> {
protected:
    std::vector<Sphere> spheres(const Mesh& mesh, std::size_t count, const Settings& parameters = {}) {
        QuietContext context;
        return stage(GetParam(), parameters)->spherize(shape_of(mesh), at_most(count), context).finest();
    }
};

TEST_P(HubbardAndSpawn, RowOfSpheresCoversALongBox) {
    // Equal pieces, each in its circumscribed ball, would be the best row.
    constexpr double length = 1, width = 0.2;
    const Mesh mesh = box({length, width, width});
    for (const int count : {2, 3, 5}) {
        const double a = length / count, r = std::sqrt(a * a / 4 + width * width / 2);
        std::vector<Sphere> row;
        for (int i = 0; i < count; ++i) {
            row.push_back({{(i + 0.5) * a - length / 2, 0, 0}, r});
        }
        const double best = union_volume(row) / (length * width * width) - 1;
        EXPECT_LT(excess(mesh, spheres(mesh, static_cast<std::size_t>(count))), 1.5 * best) << count;
    }
}

TEST_P(HubbardAndSpawn, AnythingWithAnExtentIsCovered) {
    Mesh sheet;
    sheet.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    sheet.triangles = {{0, 1, 2}, {0, 2, 3}};
    Mesh needle;
    needle.vertices = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
    needle.triangles = {{0, 1, 2}};
    Mesh dot;
    dot.vertices = {{1, 1, 1}, {1, 1, 1}, {1, 1, 1}};
    dot.triangles = {{0, 1, 2}};
    Mesh parts = box({0.1, 0.1, 0.1});
    append(parts, ball(0.05));
    append(parts, box({0.3, 0.2, 0.0005}, {0.5, 0, 0}));
    for (const Mesh& mesh : {sheet, needle, dot, parts}) {
        for (const std::size_t count : {1, 3, 7}) {
            const std::vector<Sphere> found = spheres(mesh, count);
            ASSERT_GE(found.size(), 1u);
            ASSERT_LE(found.size(), count);
            const auto solid = Solid::make(mesh);
            EXPECT_LE(largest_gap(*solid, found), 0.01 * solid->bounds().diagonal());
        }
    }
}

TEST_P(HubbardAndSpawn, TheirParametersAreUsed) {
    const Mesh mesh = bracket(0.2, 0.05);
    const std::string samples = GetParam() == "spherize.hubbard" ? "num_samples" : "initSpheres";
    EXPECT_NE(spheres(mesh, 5), spheres(mesh, 5, {{samples, 60}}));
    EXPECT_NE(spheres(mesh, 5), spheres(mesh, 5, {{"numCover", 300}}));
    QuietContext context;
    EXPECT_EQ(stage(GetParam(), {{"branch", 5}})->spherize(shape_of(mesh), {}, context).finest().size(), 5u);
}

INSTANTIATE_TEST_SUITE_P(Stages, HubbardAndSpawn, testing::Values("spherize.hubbard", "spherize.spawn"),
                         [](const auto& test) { return test.param.substr(test.param.find('.') + 1); });

} // namespace
