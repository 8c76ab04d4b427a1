// Work that is to end: whoever asks the thread is told, and everything that takes long asks.
#include <foam/base/cancellation.hpp>
#include <foam/base/error.hpp>
#include <foam/base/parallel.hpp>
#include <foam/geometry/cell.hpp>
#include <foam/geometry/inner.hpp>
#include <foam/geometry/internal/solids.hpp>
#include <foam/geometry/measure.hpp>
#include <foam/geometry/mesh_checks.hpp>
#include <foam/geometry/volumes.hpp>
#include <foam/search/spherize.hpp>

#include <gmock/gmock.h>

#include <atomic>
#include <functional>

namespace foam {
namespace {

/// Says yes from the given question on.
class From final : public StopRequest {
public:
    explicit From(std::size_t question) : left_(question) {}
    bool asked() const override { return ++questions_ > left_; }
    std::size_t questions() const { return questions_; }

private:
    mutable std::atomic<std::size_t> questions_{0};
    std::size_t left_;
};

class Patient final : public StopRequest {
public:
    bool asked() const override { return true; }
    bool overdue() const override { return late; }
    bool late = false;
};

/// A ball of some ten thousand triangles.
Mesh ball() {
    constexpr std::uint32_t rings = 70, around = 80;
    Mesh mesh;
    for (std::uint32_t i = 0; i <= rings; ++i) {
        for (std::uint32_t k = 0; k < around; ++k) {
            const double polar = 3.14159265358979 * i / rings, turn = 2 * 3.14159265358979 * k / around;
            mesh.vertices.push_back({std::sin(polar) * std::cos(turn), std::sin(polar) * std::sin(turn),
                                     i == 0 ? 1.0 : i == rings ? -1.0 : std::cos(polar)});
        }
    }
    for (std::uint32_t i = 0; i < rings; ++i) {
        for (std::uint32_t k = 0; k < around; ++k) {
            const std::uint32_t a = i * around + k, b = i * around + (k + 1) % around;
            mesh.triangles.push_back({a, a + around, b});
            mesh.triangles.push_back({b, a + around, b + around});
        }
    }
    return mesh;
}

std::vector<Sphere> row_of(std::size_t count) {
    std::vector<Sphere> spheres;
    for (std::size_t i = 0; i < count; ++i) {
        spheres.push_back({{0.01 * static_cast<double>(i), 0, 0}, 0.5});
    }
    return spheres;
}

bool is_cancelled(const std::function<void()>& work) {
    try {
        work();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::cancelled) << error.what();
        return true;
    }
    return false;
}

TEST(Cancellation, NobodyAsksAThreadWithoutARequest) {
    EXPECT_FALSE(cancelled());
    EXPECT_NO_THROW(check_cancelled());
    const From request(0);
    {
        const StopScope scope(&request);
        EXPECT_TRUE(cancelled());
        const StopScope none(nullptr);
        EXPECT_FALSE(cancelled());
    }
    EXPECT_FALSE(cancelled());
}

TEST(Cancellation, WhoWindsUpHasUntilTheRequestIsOverdue) {
    Patient request;
    const StopScope scope(&request);
    EXPECT_TRUE(cancelled());
    {
        const WindUpScope winding_up;
        EXPECT_FALSE(cancelled());
        std::atomic<int> bodies = 0;
        parallel_for(100, [&](std::size_t) { ++bodies; });
        EXPECT_EQ(bodies, 100) << "threads that help wind up, too";
        request.late = true;
        EXPECT_TRUE(cancelled());
        const StopScope other(&request);
        request.late = false;
        EXPECT_TRUE(cancelled()) << "work for another request does not wind up yet";
    }
    EXPECT_TRUE(cancelled());
}

TEST(Cancellation, ACounterAsksAtEveryNthCall) {
    const From request(2);
    const StopScope scope(&request);
    CancellationCounter asking(10);
    for (int i = 0; i < 29; ++i) {
        EXPECT_NO_THROW(asking.check()) << i;
    }
    EXPECT_EQ(request.questions(), 2u);
    EXPECT_TRUE(is_cancelled([&] { asking.check(); }));
}

TEST(Cancellation, AParallelLoopEndsSoonForAllThreads) {
    const From request(100);
    const StopScope scope(&request);
    std::atomic<std::size_t> bodies = 0;
    EXPECT_TRUE(is_cancelled([&] { parallel_for(1'000'000, [&](std::size_t) { ++bodies; }); }));
    EXPECT_LE(bodies, 100u);
}

/// Each is to ask on its way, on a solid of its own where what it finds is kept, not only at its beginning: a request that comes later ends it, too.
class EveryLoop : public ::testing::Test {
protected:
    void expect_asks(const char* what, const std::function<void()>& work) const {
        const From never(SIZE_MAX);
        {
            const StopScope scope(&never);
            work();
        }
        EXPECT_GE(never.questions(), 3u) << what;
        for (const std::size_t question : {std::size_t{0}, never.questions() / 2}) {
            const From request(question);
            const StopScope scope(&request);
            EXPECT_TRUE(is_cancelled(work)) << what << " does not end at question " << question;
        }
    }

    const Mesh mesh = ball();
    const Mesh other = transformed(mesh, Pose{}, {1, 1, 1.01});
    const std::shared_ptr<const Solid> solid = Solid::make(mesh);
    const std::vector<Sphere> spheres = row_of(40);
};

TEST_F(EveryLoop, OfGeometryAsks) {
    expect_asks("Solid::make", [&] { Solid::make(mesh); });
    expect_asks("filled", [&] { filled(solid); });
    expect_asks("quick_solid", [&] { quick_solid({{std::make_shared<const Mesh>(mesh), {}, {}}})->contains({}); });
    expect_asks("volume of two overlapping parts", [&] {
        const auto one = std::make_shared<const Mesh>(mesh);
        Solid::make(std::vector<Solid::Part>{{one, {}, {}}, {one, {}, {}}})->volume();
    });
    expect_asks("sample_surface", [&] { solid->sample_surface(50'000, 1); });
    expect_asks("exact_union_volume", [&] { exact_union_volume(spheres); });
    expect_asks("union_volume", [&] { union_volume(spheres); });
    expect_asks("missing_volume", [&] { Solid::make(mesh)->missing_volume(spheres); });
    expect_asks("mesh_change", [&] { mesh_change(mesh, other, 1); });
    expect_asks("lies_within", [&] { lies_within(0.1, mesh, other); });
}

TEST_F(EveryLoop, OfProofsAndMeasuresAsks) {
    expect_asks("certify", [&] { certify(*solid, spheres); });
    expect_asks("certify_inner", [&] { certify_inner(*solid, spheres); });
    expect_asks("shrunk_to_fit", [&] { shrunk_to_fit(*solid, spheres); });
    expect_asks("grown_to_cover", [&] { grown_to_cover(*solid, spheres); });
    expect_asks("measure", [&] { measure(*Solid::make(mesh), spheres); });
}

TEST_F(EveryLoop, OfSearchesAsks) {
    expect_asks("spherize, fast", [&] { spherize(*Solid::make(mesh), 6, {.effort = Effort::fast}); });
    expect_asks("spherize, normal", [&] { spherize(*Solid::make(mesh), 6); });
    expect_asks("spherize, protrusion", [&] { spherize(*Solid::make(mesh), 4, {.objective = Objective::protrusion}); });
    expect_asks("spheres_inside", [&] { spheres_inside(*Solid::make(mesh), 6); });
}

} // namespace
} // namespace foam
