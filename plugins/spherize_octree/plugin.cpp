// spherize.octree: balls around the cells of an octree.
#include "octree.hpp"

#include <foam/base/error.hpp>
#include <foam/geometry/measure.hpp>
#include <foam/sdk/plugin.hpp>

#include <optional>

namespace foam::spherize_octree {
namespace {

/// Returns balls inside the solid in place of the covering ones.
SphereTree inner_tree(const Octree& octree, const std::string& name) {
    std::vector<Sphere> balls;
    for (const Cell* cell : octree.leaf_cells()) {
        if (const auto ball = cell->inner_ball()) {
            balls.push_back(*ball);
        }
    }
    if (balls.empty()) {
        throw Error(ErrorCode::geometry,
                    "spherize.octree: " + name +
                        " has no interior that a sphere would fit in; remedy: guarantee outer or fitted");
    }
    return flat_tree(std::move(balls));
}

class OctreeSpherizer final : public Spherizer {
public:
    explicit OctreeSpherizer(const Parameters& parameters)
        : depth_(static_cast<int>(parameters.integer("depth"))),
          most_(static_cast<std::size_t>(parameters.integer("most"))), axes_(parameters.text("axes")),
          content_(parameters.text("content") == "solid" ? Cell::Content::solid : Cell::Content::surface) {}

    SphereTree spherize(const Shape& shape, const Budget& budget, Context& context) const override {
        const auto within = [&](std::size_t count) { return best_of(shape, budget.guarantee, count, context); };
        if (budget.max_protrusion) {
            return fewest_within(shape.original(), *budget.max_protrusion, budget.max_spheres.value_or(most_), within);
        }
        if (budget.max_spheres) {
            return within(*budget.max_spheres);
        }
        Best best;
        for (const auto& [axes, place] : starts(shape.original())) {
            Octree octree(shape.original(), axes, place, content_);
            octree.split_all(depth_, context);
            best.offer(std::move(octree));
        }
        return finished(*best.octree, shape, budget.guarantee);
    }

private:
    /// Returns the cubes to start from. A slender part in the corner of its cube occupies fewer octants.
    std::vector<std::pair<Axes, Octree::Place>> starts(const Solid& solid) const {
        std::vector<Axes> orientations;
        if (axes_ != "principal") {
            orientations.push_back({Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}});
        }
        if (axes_ != "frame") {
            orientations.push_back(principal_axes(solid));
        }
        std::vector<std::pair<Axes, Octree::Place>> starts;
        for (const Axes& axes : orientations) {
            starts.emplace_back(axes, Octree::Place::middle);
            starts.emplace_back(axes, Octree::Place::corner);
        }
        return starts;
    }

    /// The octree whose balls have the least union volume.
    struct Best {
        std::optional<Octree> octree;
        double volume = 0;

        void offer(Octree other) {
            constexpr std::size_t directions = 300; // well below a per cent of error
            const double other_volume = union_volume(other.leaf_balls(), directions);
            if (!octree || other_volume < volume) {
                volume = other_volume;
                octree = std::move(other);
            }
        }
    };

    /// Returns the best octree of at most `most` leaves: split where it reduces the volume most, from one cell and from
    /// whole levels. From one cell alone the search may end at once: eight balls around a ring have more excess volume
    /// than one, sixty-four have less.
    SphereTree best_of(const Shape& shape, Guarantee guarantee, std::size_t most, Context& context) const {
        Best best;
        for (const auto& [axes, place] : starts(shape.original())) {
            std::size_t coarser = 0;
            for (int level = 0;; ++level) {
                Octree octree(shape.original(), axes, place, content_);
                octree.split_all(level, context);
                const std::size_t leaves = octree.leaf_balls().size();
                if (leaves > most || leaves == coarser) {
                    break;
                }
                coarser = leaves;
                octree.split_best(most, context);
                best.offer(std::move(octree));
            }
        }
        return finished(*best.octree, shape, guarantee);
    }

    static SphereTree finished(const Octree& octree, const Shape& shape, Guarantee guarantee) {
        return guarantee == Guarantee::inner ? inner_tree(octree, shape.name()) : octree.tree();
    }

    int depth_;
    std::size_t most_;
    std::string axes_;
    Cell::Content content_;
};

} // namespace
} // namespace foam::spherize_octree

FOAM_PLUGIN("spherize_octree", "1.0", "Apache-2.0") {
    using foam::Parameter;
    enrol.add<foam::spherize_octree::OctreeSpherizer>({
        .name = "spherize.octree",
        .summary =
            "Balls around the cells of an octree, each the smallest that contains the part of the solid in its cell",
        .reference =
            "Hubbard 1996, Approximating polyhedra with spheres for time-critical collision detection (octree method)",
        .revision = 2,
        .parameters =
            {Parameter::integer("depth", 1)
                 .unit("1")
                 .bounds(1, 8)
                 .doc("Halvings of the bounding cube, where no number of spheres is asked for.")
                 .source("Coumar et al. 2025"),
             Parameter::integer("most", 512)
                 .unit("1")
                 .bounds(1, 4096)
                 .doc("Most spheres where only a protrusion is asked for.")
                 .source("a bound on the time of the search"),
             Parameter::choice("axes", {"best", "frame", "principal"}, "best")
                 .doc("Directions of the cube: the frame's, the solid's principal ones, or what gives the smaller "
                      "volume.")
                 .source("a cube along the frame suits boxes, one along the solid suits parts that lie at an angle"),
             Parameter::choice("content", {"solid", "surface"}, "solid")
                 .doc("What the balls hold: the solid with its interior, or its surface alone.")
                 .source("Bradshaw and O'Sullivan 2004: solid or shell")},
        .extensions = {},
        .original_only = true,
    });
}
