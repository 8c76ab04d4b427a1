#include "promises.hpp"

#include <foam/base/error.hpp>
#include <foam/geometry/measure.hpp>
#include <foam/geometry/volumes.hpp>

#include <cmath>

namespace foam::inline runtime {
namespace {

constexpr std::size_t most_asked = 4;

/// Returns a tree of one sphere around the solid.
SphereTree one_around(const Solid& solid) {
    return flat_tree({minimum_enclosing_sphere(solid.surface().vertices)});
}

double covering_volume(const Solid& solid, const SphereTree& tree) {
    return geometry::joint_volume(solid, grown_to_cover(solid, tree.finest()));
}

void require_good(const SphereTree& tree) {
    require(!tree.levels.empty() && !tree.finest().empty(), "it returns no spheres");
    require(tree.finest().size() <= most_asked,
            fmt::format("it returns {} spheres where at most {} are allowed", tree.finest().size(), most_asked));
    for (const Sphere& s : tree.finest()) {
        require(is_finite(s.center) && std::isfinite(s.radius) && s.radius >= 0, "it returns a sphere that is not finite");
    }
}

template <class Look> void for_each_solid(const Refiner& refiner, const Look& look) {
    for (const auto& [name, make] : sample::solids()) {
        const auto solid = make();
        const Shape shape(name, solid, solid);
        try {
            const auto refinement = refiner.begin(shape, {});
            require(refinement != nullptr, "it begins no refinement");
            look(*solid, *refinement);
        } catch (const std::exception& error) {
            throw Breach(fmt::format("{}: {}", name, error.what()));
        }
    }
}

} // namespace

void check_refiner(const Refiner& refiner, Promises& promises) {
    promises.check("keeps the budget, and gives the same spheres every time", [&] {
        for_each_solid(refiner, [](const Solid& solid, Refinement& refinement) {
            QuietContext context;
            const SphereTree tree = one_around(solid), first = refinement.refine(tree, most_asked, context);
            require_good(first);
            require(refinement.refine(tree, most_asked, context).finest() == first.finest(),
                    "the second call gives other spheres");
        });
    });
    promises.check("never increases the excess volume", [&] {
        for_each_solid(refiner, [](const Solid& solid, Refinement& refinement) {
            QuietContext context;
            const SphereTree tree = one_around(solid);
            const double before = covering_volume(solid, tree),
                         after = covering_volume(solid, refinement.refine(tree, most_asked, context));
            require(after <= before * (1 + 1e-4),
                    fmt::format("spheres and solid together have {:.6g} m³ after {:.6g} m³", after, before));
        });
    });
    promises.check("returns its result so far when the user has asked to stop", [&] {
        for_each_solid(refiner, [](const Solid& solid, Refinement& refinement) {
            Stopped stopped;
            try {
                require_good(refinement.refine(one_around(solid), most_asked, stopped));
            } catch (const Error& error) {
                require(error.code() == ErrorCode::cancelled, error.what());
            }
        });
    });
}

} // namespace foam::runtime
