// The inside of a solid on a grid, on lines, and its distances.
#pragma once

#include "by_spheres/measured/points.hpp"

namespace foam::inline search::by_spheres {

/// Shares of cells inside the solid on a cubic lattice over its bounds, in the unit frame. Where lines along an axis
/// cross a closed surface, they separate inside and outside exactly; where they run through holes, the winding number
/// decides.
class Occupancy {
public:
    /// `resolution`: cells along the longest extent. O(area / cell²) for closed solids, plus the triangles.
    Occupancy(const Solid& solid, const Frame& frame, int resolution);

    /// Returns the outside share at a point of the unit frame: 0 inside, 1 outside, between them within a cell of the
    /// surface.
    float outside(float x, float y, float z) const {
        const float fx = (x - low_[0]) * inverse_, fy = (y - low_[1]) * inverse_, fz = (z - low_[2]) * inverse_;
        if (!(fx > 0 && fy > 0 && fz > 0 && fx < last_[0] && fy < last_[1] && fz < last_[2])) {
            return 1;
        }
        const int ix = static_cast<int>(fx), iy = static_cast<int>(fy), iz = static_cast<int>(fz);
        const float tx = fx - static_cast<float>(ix), ty = fy - static_cast<float>(iy),
                    tz = fz - static_cast<float>(iz);
        const float* c = outside_.data() + index(ix, iy, iz);
        const float* d = c + row_ * rows_;
        const float a = mix(mix(c[0], c[1], tx), mix(c[row_], c[row_ + 1], tx), ty);
        const float b = mix(mix(d[0], d[1], tx), mix(d[row_], d[row_ + 1], tx), ty);
        return mix(a, b, tz);
    }
    float cell() const { return 1 / inverse_; }
    /// Volume of the solid by the cells, units³.
    double volume() const { return volume_; }
    /// Centres of the cells that are at least half inside.
    const Points& inside() const { return inside_; }
    /// Distance from each of them to the nearest cell that is not, minus half a cell.
    const std::vector<float>& depth() const { return depth_; }

private:
    static float mix(float a, float b, float t) { return a + (b - a) * t; }
    std::size_t index(int ix, int iy, int iz) const {
        return static_cast<std::size_t>(ix) +
               row_ * (static_cast<std::size_t>(iy) + rows_ * static_cast<std::size_t>(iz));
    }
    void find_depths();

    float low_[3]{}, last_[3]{}; // centre of the first cell; index of the last one
    float inverse_ = 1;
    std::size_t row_ = 0, rows_ = 0, slices_ = 0;
    std::vector<float> outside_;
    double volume_ = 0;
    Points inside_;
    std::vector<float> depth_;
};

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

/// Distances to the surface, negative inside, on a cubic lattice over the solid's bounds and slightly beyond, in the
/// unit frame. They are interpolated between the nodes, and exact near flat faces.
class DistanceField {
public:
    /// `resolution`: cells along the longest extent of the bounds. O(resolution³ log triangles).
    DistanceField(const Solid& solid, const Frame& frame, int resolution);

    /// Returns the distance. Beyond the lattice it is an upper bound, from the nearest place on it.
    float at(float x, float y, float z) const;
    /// About `most` nodes within the solid's bounds, and their distances.
    struct Nodes {
        Points places;
        std::vector<float> distance;
    };
    Nodes nodes_within_bounds(std::size_t most) const;

private:
    Vec3 place(std::size_t node) const;

    Vec3 half_{};    ///< of the bounds, which are centred at the origin
    float low_[3]{}; ///< first node
    float cell_ = 1; ///< distance of nodes
    int count_[3]{}; ///< number of nodes
    std::vector<float> distance_;
};

} // namespace foam::inline search::by_spheres
