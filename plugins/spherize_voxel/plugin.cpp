// spherize.voxel: equal spheres on a voxel grid.
#include "radius_search.hpp"

#include <foam/base/error.hpp>
#include <foam/sdk/plugin.hpp>

#include <algorithm>

namespace foam::spherize_voxel {
namespace {

/// Returns the largest balls inside the solid about the voxels, no larger than the spheres that they replace.
std::vector<Sphere> inner_balls(const RadiusSearch::Result& outer, const std::string& name) {
    std::vector<Sphere> balls;
    for (std::size_t i = 0; i < outer.voxels.size(); ++i) {
        if (auto ball = outer.voxels[i].inner_ball()) {
            ball->radius = std::min(ball->radius, outer.spheres[i].radius);
            balls.push_back(*ball);
        }
    }
    if (balls.empty()) {
        throw Error(ErrorCode::geometry,
                    "spherize.voxel: " + name +
                        " has no interior that a sphere would fit in; remedy: guarantee outer or fitted");
    }
    return balls;
}

SphereTree tree(const Sphere& root, std::vector<Sphere> spheres) {
    SphereTree tree;
    tree.levels.resize(2);
    tree.levels[0].elements.spheres() = {root};
    tree.levels[1].parents.assign(spheres.size(), 0);
    tree.levels[1].elements.spheres() = std::move(spheres);
    return tree;
}

struct Settings {
    double radius, spacing; ///< m
    std::size_t most;
    bool principal;
    Cell::Content content;
};

std::array<Vec3, 3> axes_of(const Solid& solid, const Settings& settings) {
    return settings.principal ? principal_axes(solid)
                              : std::array<Vec3, 3>{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
}

/// The voxels of one shape; the radii that were tried serve all budgets.
class VoxelSearch final : public SphereSearch {
public:
    VoxelSearch(const Shape& shape, const Settings& settings)
        : shape_(shape), settings_(settings),
          lattice_(shape.original(), axes_of(shape.original(), settings), settings.content, settings.spacing),
          radii_(lattice_) {}

    std::vector<SphereTree> at_most(std::span<const Budget> budgets, Context& context) override {
        std::vector<SphereTree> trees;
        for (const Budget& budget : budgets) {
            trees.push_back(at_most(budget, context));
        }
        return trees;
    }

private:
    SphereTree at_most(const Budget& budget, Context& context) {
        const auto finished = [&](RadiusSearch::Result outer) {
            return tree(lattice_.whole().ball(), budget.guarantee == Guarantee::inner
                                                     ? inner_balls(outer, shape_.name())
                                                     : std::move(outer.spheres));
        };
        const auto within = [&](std::size_t count) { return finished(radii_.best(count, context)); };
        if (budget.max_protrusion) {
            return fewest_within(shape_.original(), *budget.max_protrusion, budget.max_spheres.value_or(settings_.most),
                                 within);
        }
        return budget.max_spheres ? within(*budget.max_spheres) : finished(of_radius(context));
    }

    /// Returns spheres of the parameter's radius, if they are not too many.
    RadiusSearch::Result of_radius(Context& context) {
        RadiusSearch::Result result;
        if (lattice_.voxels_of_box(settings_.radius) <= most_voxels(settings_.most)) {
            result.voxels = lattice_.filled(settings_.radius);
        }
        if (result.voxels.empty() || result.voxels.size() > settings_.most) {
            context.log(Severity::warning, shape_.name() + ": spheres of the radius asked for are more than " +
                                               std::to_string(settings_.most) +
                                               " here, larger ones are taken; remedy: raise radius or most");
            return radii_.best(settings_.most, context);
        }
        result.spheres = lattice_.spheres(result.voxels, settings_.radius);
        return result;
    }

    const Shape& shape_;
    const Settings& settings_;
    Lattice lattice_;
    RadiusSearch radii_;
};

class VoxelSpherizer final : public Spherizer {
public:
    explicit VoxelSpherizer(const Parameters& parameters)
        : settings_{.radius = parameters.number("radius"),
                    .spacing = parameters.number("spacing"),
                    .most = static_cast<std::size_t>(parameters.integer("most")),
                    .principal = parameters.text("axes") != "frame",
                    .content = parameters.text("content") == "solid" ? Cell::Content::solid : Cell::Content::surface} {}

    SphereTree spherize(const Shape& shape, const Budget& budget, Context& context) const override {
        return search(shape)->at_most({&budget, 1}, context).front();
    }
    std::unique_ptr<SphereSearch> search(const Shape& shape) const override {
        return std::make_unique<VoxelSearch>(shape, settings_);
    }

private:
    Settings settings_;
};

} // namespace
} // namespace foam::spherize_voxel

FOAM_PLUGIN("spherize_voxel", "1.0", "Apache-2.0") {
    using foam::Parameter;
    enrol.add<foam::spherize_voxel::VoxelSpherizer>({
        .name = "spherize.voxel",
        .summary = "Equal spheres on a voxel grid: one around each voxel that contains a part of the solid",
        .reference = "Sundaralingam et al. 2023, cuRobo (spheres of a given radius by voxelization)",
        .parameters =
            {Parameter::number("radius", 0.02)
                 .unit("m")
                 .bounds(1e-6, 1e3)
                 .doc("Radius of the spheres, where no number of them is asked for; with a number it is searched for.")
                 .source("Coumar et al. 2025 compare with 2 cm and 1 cm"),
             Parameter::number("spacing", 1.15)
                 .unit("1")
                 .bounds(0.1, 4)
                 .doc("Edge of a voxel in radii: less lets spheres overlap more, more leaves gaps that only growing "
                      "closes.")
                 .source("2/√3 = 1.1547 is the most at which a sphere holds its voxel"),
             Parameter::integer("most", 2048)
                 .unit("1")
                 .bounds(1, 100'000)
                 .doc("Most spheres where no number is asked for; if the radius would take more, they are larger.")
                 .source("a bound on time and memory; the paper shows up to 1000"),
             Parameter::choice("axes", {"frame", "principal"}, "frame")
                 .doc("Directions of the grid: the frame's or the solid's principal ones.")
                 .source("planners' tools lay the grid along the frame"),
             Parameter::choice("content", {"solid", "surface"}, "solid")
                 .doc("Which voxels count: all that hold some of the solid, or its surface alone.")
                 .source("metrics: interior outside of the spheres counts as missing")},
        .extensions = {},
        .original_only = true,
    });
}
