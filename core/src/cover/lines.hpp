// Where a lattice of parallel lines runs inside a solid: triangles are drawn on the lattice as a rasteriser does.
#pragma once

#include "cover/points.hpp"

namespace foam::cover {

/// A lattice of lines along one axis.
struct LineLattice {
    int axis = 0;              ///< of the lines; the others are axis + 1 and axis + 2, cyclic
    double low[2]{}, step = 1; ///< position of the first line across, distance between lines
    int count[2]{};
};

/// The pieces of each line inside, [enter, leave] pairs; a line along which the winding number does not come back to
/// zero runs through a hole and says nothing: `sound` is then 0.
struct LinePieces {
    std::vector<std::size_t> first; ///< of each line in `pieces`, and the end: lines + 1 values
    std::vector<std::pair<double, double>> pieces;
    std::vector<char> sound;
};

LinePieces pieces_along(const Mesh& surface, const Frame& frame, const LineLattice& lattice);

} // namespace foam::cover
