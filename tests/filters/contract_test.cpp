// What every mesh filter owes: finite vertices, indices in range, the same output for any number of threads and any
// number of calls, closed in - closed out, and errors instead of crashes.
#include "filters.hpp"

#include <foam/base/parallel.hpp>

namespace foam::test {
namespace {

std::vector<std::string> filter_names() {
    std::vector<std::string> names;
    for (const auto& [name, stage] : registry().stages()) {
        if (stage.kind == StageKind::mesh_filter) {
            names.push_back(name);
        }
    }
    return names;
}

class EveryFilter : public ::testing::TestWithParam<std::string> {};

TEST_P(EveryFilter, KeepsSoundMeshesSound) {
    for (const Named& shape : sound_meshes()) {
        SCOPED_TRACE(shape.name);
        const Mesh result = filtered(GetParam(), shape.mesh);
        expect_solid(result);
        // A wrap lies outside of what it wraps: plates become thicker, cavities are closed.
        if (GetParam() != "repair.wrap" || (shape.name != "thin plate" && shape.name != "cavity")) {
            EXPECT_NEAR(signed_volume(result), signed_volume(shape.mesh), 0.1 * signed_volume(shape.mesh));
        }
        const Box before = bounds(shape.mesh), after = bounds(result);
        EXPECT_LT(distance(before.low, after.low) + distance(before.high, after.high), 0.1 * before.diagonal());
    }
}

TEST_P(EveryFilter, GivesTheSameOnAnyNumberOfThreads) {
    const Mesh mesh = filtered("repair.watertight", soup(40), {{"leaves", std::int64_t{300}}});
    const auto made = filter(GetParam());
    std::vector<Mesh> results;
    for (const std::size_t threads : {1, 4}) {
        const ThreadLimit limit(threads);
        QuietContext context;
        results.push_back(made->apply(mesh, context));
    }
    EXPECT_EQ(results[0], results[1]);
}

TEST_P(EveryFilter, IsUsedByManyThreadsAtOnce) {
    const auto made = filter(GetParam());
    const std::vector<Named> shapes = sound_meshes();
    std::vector<Mesh> alone(shapes.size()), together(shapes.size());
    for (std::size_t i = 0; i < shapes.size(); ++i) {
        QuietContext context;
        alone[i] = made->apply(shapes[i].mesh, context);
    }
    parallel_for(shapes.size(), [&](std::size_t i) {
        QuietContext context;
        together[i] = made->apply(shapes[i].mesh, context);
    });
    EXPECT_EQ(alone, together);
}

TEST_P(EveryFilter, LeavesItsInputAlone) {
    const Mesh mesh = noisy(torus(0.2, 0.06), 0.005), copy = mesh;
    filtered(GetParam(), mesh);
    EXPECT_EQ(mesh, copy);
}

TEST_P(EveryFilter, SolvesOrRefusesDefectiveMeshes) {
    for (const Named& shape : defective_meshes()) {
        SCOPED_TRACE(shape.name);
        QuietContext context;
        try {
            EXPECT_TRUE(is_usable(filter(GetParam())->apply(shape.mesh, context)));
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::geometry) << error.what();
        }
    }
}

TEST_P(EveryFilter, RefusesBrokenInput) {
    const double infinity = std::numeric_limits<double>::infinity();
    Mesh bad_index = box({}, {1, 1, 1});
    bad_index.triangles[3][1] = 99;
    EXPECT_NE(refusal(GetParam(), bad_index).find("vertex 99"), std::string::npos);
    for (const double value : {infinity, -infinity, std::numeric_limits<double>::quiet_NaN()}) {
        Mesh bad_vertex = box({}, {1, 1, 1});
        bad_vertex.vertices[5].y = value;
        EXPECT_NE(refusal(GetParam(), bad_vertex).find("finite"), std::string::npos);
    }
}

TEST_P(EveryFilter, StopsWhenAsked) {
    struct Stopped final : QuietContext {
        bool cancelled() const override { return true; }
    } context;
    const Mesh mesh = without(ball({}, 1, 64), 0, 10);
    try {
        filter(GetParam())->apply(mesh, context);
        ADD_FAILURE() << "was not stopped";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::cancelled);
    }
}

TEST_P(EveryFilter, DeclaresItsParametersWell) {
    const StageInfo& info = registry().find(GetParam())->info;
    EXPECT_FALSE(info.summary.empty());
    EXPECT_FALSE(info.reference.empty());
    for (const Parameter& parameter : info.parameters) {
        SCOPED_TRACE(parameter.name);
        EXPECT_FALSE(parameter.doc_text.empty());
        EXPECT_FALSE(parameter.source_text.empty());
        if (parameter.type == Parameter::Type::integer || parameter.type == Parameter::Type::number) {
            EXPECT_FALSE(parameter.unit_text.empty());
            EXPECT_TRUE(parameter.low && parameter.high);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Registered, EveryFilter, ::testing::ValuesIn(filter_names()), [](const auto& instance) {
    std::string name = instance.param;
    std::replace(name.begin(), name.end(), '.', '_');
    return name;
});

TEST(Filters, AreAllThere) {
    const std::vector<std::string> names = filter_names();
    for (const char* name : {"repair.auto", "repair.soup", "repair.watertight", "simplify.meshoptimizer",
                             "simplify.quadric", "smooth.laplacian", "smooth.taubin", "smooth.humphrey"}) {
        EXPECT_NE(std::find(names.begin(), names.end(), name), names.end()) << name;
    }
}

} // namespace
} // namespace foam::test
