// Elements that descend together, and the lattice that tells what they add outside a solid.
#include "search/src/convex/cells.hpp"
#include "search/src/convex/fit_programme.hpp"
#include "search/src/convex/least_fit.hpp"

#include <foam/base/random.hpp>
#include <foam/geometry/element.hpp>
#include <foam/geometry/solid.hpp>

#include <gtest/gtest.h>

#include <memory>

namespace {

using namespace foam;
using namespace foam::search::convex;
using Kind = Element::Kind;

std::shared_ptr<const Solid> boxes(const std::vector<Box>& all) {
    std::vector<Solid::Part> parts;
    for (const Box& box : all) {
        Solid::Part part;
        part.primitive = Element::box(box.size());
        part.pose.translation = box.center();
        parts.push_back(part);
    }
    return Solid::make(std::move(parts));
}
struct Scene {
    explicit Scene(std::shared_ptr<const Solid> given)
        : solid(std::move(given)), body(body_of(*solid)), occupancy(*solid, by_spheres::Frame(solid->bounds()), 48) {}

    std::shared_ptr<const Solid> solid;
    BodyOfSolid body;
    by_spheres::Occupancy occupancy;

    /// Returns a fit in the body's frame from one in metres.
    Fit in_units(Fit fit) const {
        fit.center = (fit.center - body.origin) / body.unit;
        fit.half = fit.half / body.unit;
        fit.radius /= body.unit;
        return fit;
    }
    double outside(const std::vector<Fit>& fits) const {
        Box region;
        for (const Fit& fit : fits) {
            const Box box = bounds(fit);
            region.add(box.low - Vec3{0.1, 0.1, 0.1});
            region.add(box.high + Vec3{0.1, 0.1, 0.1});
        }
        OutsideLattice lattice(occupancy);
        constexpr std::size_t fine = 60'000;
        lattice.look({}, region, fine);
        return lattice.of(fits);
    }
    bool all_held(const std::vector<Fit>& fits) const {
        Cloud frame;
        frame.origin = body.origin;
        frame.unit = body.unit;
        std::vector<Element> elements;
        for (const Fit& fit : fits) {
            elements.push_back(element_of(fit, frame));
        }
        const Mesh& surface = solid->surface();
        Random random(5);
        for (const Triangle& t : surface.triangles) {
            for (int i = 0; i < 2000; ++i) {
                double u = random.uniform(), v = random.uniform();
                if (u + v > 1) {
                    u = 1 - u;
                    v = 1 - v;
                }
                const Vec3 &a = surface.vertices[t[0]], &b = surface.vertices[t[1]], &c = surface.vertices[t[2]];
                const Vec3 p = a + (b - a) * u + (c - a) * v;
                if (std::none_of(elements.begin(), elements.end(),
                                 [&](const Element& e) { return foam::holds(e, p, -1e-6 * body.unit); })) {
                    return false;
                }
            }
        }
        return true;
    }
};

TEST(OutsideLattice, HasTheVolumeOfEveryKind) {
    const Scene scene(boxes({Box{{-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1}}}));
    const double inside = scene.solid->volume() / std::pow(scene.body.unit, 3);
    const Fit turned_axes{.axes = turned({Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}, {0.3, -0.5, 0.8})};
    for (const Kind kind : {Kind::sphere, Kind::capsule, Kind::cylinder, Kind::box, Kind::swept_box, Kind::ellipsoid}) {
        Fit fit = turned_axes;
        fit.kind = kind;
        fit.half = kind == Kind::sphere                              ? Vec3{}
                   : kind == Kind::capsule || kind == Kind::cylinder ? Vec3{0, 0, 0.25}
                                                                     : Vec3{0.25, 0.2, 0.3};
        fit.radius = kind == Kind::box || kind == Kind::ellipsoid ? 0 : kind == Kind::swept_box ? 0.05 : 0.3;
        fit = scene.in_units(fit);
        EXPECT_NEAR(scene.outside({fit}), volume(fit) - inside, 0.02 * volume(fit)) << to_string(kind);
        EXPECT_NEAR(scene.outside({fit, fit}), scene.outside({fit}), 1e-12) << "twice the same counts once";
    }
}

TEST(OutsideLattice, CountsWhatIsBeyondTheRegionAndNotWhatOthersHold) {
    const Scene scene(boxes({Box{{-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1}}}));
    const Fit ball = scene.in_units({.kind = Kind::sphere, .center = {1, 0, 0}, .radius = 0.2});
    OutsideLattice lattice(scene.occupancy);
    lattice.look({}, scene.solid->bounds(), 1000);
    EXPECT_GE(lattice.of({&ball, 1}), volume(ball));
    const std::vector<Fit> others{ball};
    lattice.look(others, bounds(ball), 8000);
    EXPECT_LT(lattice.of({&ball, 1}), 0.1 * volume(ball)); // both surfaces are blurred
}

TEST(JointDescent, TwoTurnedBoxesBecomeAnL) {
    const Box one{{0, 0, 0}, {1, 0.2, 0.2}}, two{{0, 0, 0}, {0.2, 1, 0.2}};
    const Scene scene(boxes({one, two}));
    const auto turned_around = [&](const Box& box, const Vec3& by) {
        Cloud corners;
        for (int i = 0; i < 8; ++i) {
            corners.points.push_back(
                {i & 1 ? box.low.x : box.high.x, i & 2 ? box.low.y : box.high.y, i & 4 ? box.low.z : box.high.z});
        }
        Fit fit{.kind = Kind::box, .axes = turned(Fit{}.axes, by), .center = box.center()};
        close_around(fit, corners);
        return scene.in_units(fit);
    };
    const std::vector<Fit> start{turned_around(one, {0, 0.1, 0.15}), turned_around(two, {0.1, 0, -0.15})};
    ASSERT_TRUE(scene.all_held(start));
    const std::vector<Fit> found = descended_together(scene.body.body, scene.occupancy, start, Effort::normal, false);
    ASSERT_EQ(found.size(), 2u);
    EXPECT_TRUE(scene.all_held(found));
    EXPECT_LT(scene.outside(found), 0.1 * scene.outside(start));
    for (const Fit& fit : descended_together(scene.body.body, scene.occupancy, start, Effort::normal, true)) {
        EXPECT_TRUE(fit.axes == start[0].axes || fit.axes == start[1].axes) << "its axes are kept";
    }
}

TEST(JointDescent, EveryKindGoesOnToHold) {
    const Scene scene(boxes({Box{{0, 0, 0}, {1, 0.2, 0.2}}, Box{{0, 0, 0}, {0.2, 1, 0.2}}}));
    for (const Kind kind : {Kind::sphere, Kind::capsule, Kind::cylinder, Kind::swept_box, Kind::ellipsoid}) {
        const auto along = [&](const Vec3& center, const std::array<Vec3, 3>& axes) {
            Fit fit{.kind = kind, .axes = axes, .center = center, .radius = kind == Kind::sphere ? 0.7 : 0.3};
            fit.half = kind == Kind::sphere ? Vec3{} : Vec3{0, 0, 0.6};
            if (kind == Kind::ellipsoid) {
                fit.half = {0.4, 0.4, 0.9};
                fit.radius = 0;
            }
            return scene.in_units(fit);
        };
        const std::vector<Fit> start{along({0.5, 0.1, 0.1}, frame_along({1, 0, 0})),
                                     along({0.1, 0.5, 0.1}, frame_along({0, 1, 0}))};
        ASSERT_TRUE(scene.all_held(start)) << to_string(kind);
        const std::vector<Fit> found =
            descended_together(scene.body.body, scene.occupancy, start, Effort::normal, false);
        EXPECT_TRUE(scene.all_held(found)) << to_string(kind);
        EXPECT_LT(scene.outside(found), scene.outside(start)) << to_string(kind);
    }
}

TEST(JointDescent, DropsWhatHoldsNothingAlone) {
    const Scene scene(boxes({Box{{0, 0, 0}, {1, 0.2, 0.2}}}));
    const Fit all = scene.in_units({.kind = Kind::box, .center = {0.5, 0.1, 0.1}, .half = {0.5, 0.1, 0.1}});
    const Fit part = scene.in_units({.kind = Kind::sphere, .center = {0.5, 0.1, 0.1}, .radius = 0.05});
    const std::vector<Fit> found =
        descended_together(scene.body.body, scene.occupancy, {all, part}, Effort::normal, false);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found.front().kind, Kind::box);
}

} // namespace
