// plugin.cpp
// The cell with the largest ball is halved across its longest axis until there are as many balls as wanted.
#include <foam/geometry/cell.hpp>
#include <foam/sdk/plugin.hpp>

namespace {

using namespace foam;

struct Piece {
    Piece(Cell content) : cell(std::move(content)), ball(cell.ball()) {}
    Cell cell;
    Sphere ball; // the smallest that holds what lies in the cell
};

std::array<int, 3> across_longest(const Vec3& size) {
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    return {axis == 0 ? 2 : 1, axis == 1 ? 2 : 1, axis == 2 ? 2 : 1};
}

class AxisSplit final : public Spherizer {
public:
    explicit AxisSplit(const Parameters& parameters) : cells_(static_cast<std::size_t>(parameters.integer("cells"))) {}

    SphereTree spherize(const Shape& shape, const Budget& budget, Context& context) const override {
        const Solid& solid = shape.original(); // what the spheres must cover; metres, frame of the link
        std::vector<Piece> pieces{Piece(Cell::whole(solid, principal_axes(solid), Cell::Content::solid))};
        const auto less = [](const Piece& a, const Piece& b) { return a.ball.radius < b.ball.radius; };
        while (pieces.size() < budget.max_spheres.value_or(cells_)) {
            context.check_cancelled();
            const auto largest = std::max_element(pieces.begin(), pieces.end(), less);
            const Box extent = largest->cell.extent();
            const std::vector<Cell> halves = largest->cell.in_box(extent).divided(across_longest(extent.size()));
            pieces.erase(largest);
            pieces.insert(pieces.end(), halves.begin(), halves.end());
        }
        std::vector<Sphere> balls;
        for (const Piece& piece : pieces) {
            balls.push_back(piece.ball);
        }
        return flat_tree(std::move(balls));
    }

private:
    std::size_t cells_;
};

} // namespace

FOAM_PLUGIN("spherize_axis_split", "1.0", "Apache-2.0") {
    enrol.add<AxisSplit>({.name = "spherize.axis_split",
                          .summary = "The smallest ball around each cell of a split along the principal axes",
                          .reference = "Welzl 1991, Smallest enclosing disks",
                          .parameters = {Parameter::integer("cells", 8)
                                             .bounds(1, 4096)
                                             .unit("1")
                                             .doc("Number of spheres, where the recipe has no budget.")},
                          .original_only = true});
}
