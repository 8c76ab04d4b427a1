// foam.h gives the bytes of foam::spherize(), whatever the options.
#include <foam.h>
#include <foam/search/spherize.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

namespace {

/// A torus that is thin on one side.
foam::Mesh ring() {
    constexpr std::uint32_t around = 24, across = 8;
    foam::Mesh mesh;
    for (std::uint32_t i = 0; i < around; ++i) {
        const double a = 2 * M_PI * i / around, r = 0.2 + 0.1 * std::cos(a);
        for (std::uint32_t j = 0; j < across; ++j) {
            const double b = 2 * M_PI * j / across, d = 1 + r * std::cos(b);
            mesh.vertices.push_back({d * std::cos(a), d * std::sin(a), r * std::sin(b)});
            const std::uint32_t i1 = (i + 1) % around, j1 = (j + 1) % across;
            mesh.triangles.push_back({i * across + j, i1 * across + j, i1 * across + j1});
            mesh.triangles.push_back({i * across + j, i1 * across + j1, i * across + j1});
        }
    }
    return mesh;
}

int go_on(void*) {
    return FOAM_CONTINUE;
}

void expect_same(const foam::Mesh& mesh, std::size_t count, const foam_options& options,
                 const foam::CoverOptions& same) {
    std::vector<foam::Sphere> spheres(count);
    foam_report report{};
    report.size = sizeof report;
    ASSERT_EQ(FOAM_OK, foam_spherize(&mesh.vertices[0].x, mesh.vertices.size(), mesh.triangles[0].data(),
                                     mesh.triangles.size(), count, &options, &spheres[0].center.x, &report))
        << report.error;
    const foam::SphereCover cover = foam::spherize(mesh, count, same);
    spheres.resize(report.spheres);
    EXPECT_EQ(cover.spheres, spheres);
    EXPECT_EQ(cover.volume, report.volume);
}

TEST(CInterface, HasTheBytesOfSpherize) {
    const foam::Mesh mesh = ring();
    const std::pair<int, foam::Effort> efforts[] = {{FOAM_FAST, foam::Effort::fast},
                                                    {FOAM_NORMAL, foam::Effort::normal}};
    const std::pair<int, foam::Objective> objectives[] = {{FOAM_EXCESS, foam::Objective::excess},
                                                          {FOAM_PROTRUSION, foam::Objective::protrusion},
                                                          {FOAM_RADIUS, foam::Objective::radius}};
    for (const auto& [effort, same_effort] : efforts) {
        for (const auto& [objective, same_objective] : objectives) {
            for (const std::size_t count : {1, 5, 12}) {
                foam_options options{};
                options.size = sizeof options;
                options.effort = effort;
                options.objective = objective;
                options.seed = 7 + count;
                options.poll = count == 5 ? go_on : nullptr;
                expect_same(mesh, count, options,
                            {.effort = same_effort, .objective = same_objective, .seed = 7 + count});
            }
        }
    }
}

TEST(CInterface, ReportsAnExceptionOfTheCallback) {
    const foam::Mesh mesh = ring();
    foam_options options{};
    options.size = sizeof options;
    options.poll = [](void*) -> int { throw std::string("of the caller"); };
    foam_report report{};
    report.size = sizeof report;
    std::vector<foam::Sphere> spheres(3);
    EXPECT_EQ(FOAM_INTERNAL, foam_spherize(&mesh.vertices[0].x, mesh.vertices.size(), mesh.triangles[0].data(),
                                           mesh.triangles.size(), 3, &options, &spheres[0].center.x, &report));
    EXPECT_STREQ("an exception of an unknown type; remedy: let no exception leave options->poll", report.error);
}

TEST(CInterface, HasTheElementsOfCover) {
    const foam::Mesh mesh = ring();
    foam_report report{};
    report.size = sizeof report;
    foam_region* region = nullptr;
    ASSERT_EQ(FOAM_OK, foam_region_of_mesh(&mesh.vertices[0].x, mesh.vertices.size(), mesh.triangles[0].data(),
                                           mesh.triangles.size(), &region, &report));
    for (const foam::Element::Kind kind : foam::every_kind()) {
        const foam::Cover cover = foam::cover(mesh, 5, {.kinds = {kind}, .effort = foam::Effort::fast});
        foam_options options{};
        options.size = sizeof options;
        options.effort = FOAM_FAST;
        foam_elements* elements = nullptr;
        ASSERT_EQ(FOAM_OK, foam_cover(region, 5, 1U << static_cast<unsigned>(kind), &options, &elements, &report));
        ASSERT_EQ(cover.elements.size(), foam_elements_count(elements));
        // Read and made again, they are the same.
        std::vector<foam_element> described(cover.elements.size());
        for (std::size_t i = 0; i < described.size(); ++i) {
            ASSERT_EQ(FOAM_OK, foam_elements_get(elements, i, &described[i]));
            const foam::Element element = cover.elements[i];
            EXPECT_EQ(0, std::memcmp(described[i].position, &element.pose.translation, 24));
            EXPECT_EQ(0, std::memcmp(described[i].half, &element.half, 24));
            EXPECT_EQ(described[i].radius, element.radius);
        }
        foam_elements* again = nullptr;
        ASSERT_EQ(FOAM_OK, foam_elements_make(described.data(), described.size(), &again, &report)) << report.error;
        foam_certificate proof{};
        proof.size = sizeof proof;
        EXPECT_EQ(FOAM_OK, foam_certify(region, again, nullptr, &proof, &report));
        EXPECT_TRUE(proof.holds) << foam::to_string(kind);
        EXPECT_EQ(1, proof.solid);
        foam_elements_free(again);
        foam_elements_free(elements);
    }
    foam_region_free(region);
}

} // namespace
