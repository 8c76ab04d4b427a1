// Further division of cells where it reduces the volume.
#pragma once

#include "grid_search.hpp"

#include <memory>

namespace foam::spherize_grid {

/// Divides the cells of a grid into halves, quarters or eighths, always where that saves most of the union's volume per
/// additional sphere. For rising numbers of spheres it continues from its last state.
class Refinement {
public:
    explicit Refinement(const Grid& start);
    ~Refinement();
    /// Returns at most `most` cells, or those of the start. Depends only on the start and `most`, not on earlier calls.
    /// Precondition: `most` is at least that of the calls before.
    Grid at(std::size_t most, Context& context);

private:
    struct Part;
    struct Leaf;
    struct Choice;
    using Leaves = std::vector<Leaf>;
    static void measure(Leaves& leaves);
    static Choice best_choice(const Leaves& leaves, std::size_t room);
    static void divide(Leaves& leaves, const Choice& choice);

    Leaves leaves_; // as far as the divisions are the same for every larger number
};

} // namespace foam::spherize_grid
