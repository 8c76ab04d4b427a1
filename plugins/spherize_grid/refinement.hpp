// Cells divided further where that pays.
#pragma once

#include "grid_search.hpp"

#include <memory>

namespace foam::spherize_grid {

/// Divides the cells of a grid into halves, quarters or eighths, always where that saves most of the union's volume for
/// each sphere more. Asked for rising numbers of spheres it goes on from where it was.
class Refinement {
public:
    explicit Refinement(const Grid& start);
    ~Refinement();
    /// At most `most` cells, or those of the start. Depends on the start and `most` alone, not on what was asked
    /// before. Precondition: `most` is no less than in the calls before.
    Grid at(std::size_t most, Context& context);

private:
    struct Part;
    struct Leaf;
    struct Choice;
    using Leaves = std::vector<Leaf>;
    static void measure(Leaves& leaves);
    static Choice best_choice(const Leaves& leaves, std::size_t room);
    static void divide(Leaves& leaves, const Choice& choice);

    Leaves leaves_; // as far as divisions are the same for every larger number
};

} // namespace foam::spherize_grid
