// What of the surface a ball must hold because no other does.
#pragma once

#include <foam/sphere.hpp>

#include <array>
#include <span>
#include <vector>

namespace foam::medial {

using Corners = std::array<Vec3, 3>;

class Uncovered {
public:
    /// `surface` must outlive this. Pieces of triangles are not split below `resolution`.
    Uncovered(std::span<const Corners> surface, double resolution) :
        surface_(surface), resolution_(resolution), holder_(surface.size(), 0) {}

    /// Corners of the pieces of the surface that `balls[index]` must hold: no other ball holds such a piece, and none would
    /// have to grow less to do so. A ball that holds these corners, with the others as they are, covers the surface up to
    /// the growth of the others that pieces of size `resolution` ask for. Of these corners, all that can be the farthest
    /// from a centre within `shift` of the ball's.
    std::vector<Vec3> needed(std::span<const Sphere> balls, std::size_t index, double shift);

private:
    class Search;

    std::span<const Corners> surface_;
    double resolution_;
    std::vector<std::uint32_t> holder_;   ///< the ball that held the whole triangle when it was last asked
};

} // namespace foam::medial
