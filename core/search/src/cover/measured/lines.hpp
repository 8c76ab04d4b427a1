// Intersections of a lattice of parallel lines with a solid, computed by rasterising triangles.
#pragma once

#include "cover/measured/points.hpp"

namespace foam::inline search::cover {

/// A lattice of lines along one axis.
struct LineLattice {
    int axis = 0;              ///< axis of the lines; the others are axis + 1 and axis + 2, cyclic
    double low[2]{}, step = 1; ///< position of the first line across, distance between lines
    int count[2]{};
};

/// The pieces of each line inside the solid, [enter, leave] pairs. A line whose winding number does not return to zero
/// runs through a hole: then `sound` is 0 and its pieces are meaningless.
struct LinePieces {
    std::vector<std::size_t> first; ///< start of each line in `pieces`, and the end: lines + 1 values
    std::vector<std::pair<double, double>> pieces;
    std::vector<char> sound;
};

LinePieces pieces_along(const Mesh& surface, const Frame& frame, const LineLattice& lattice);

} // namespace foam::search::cover
