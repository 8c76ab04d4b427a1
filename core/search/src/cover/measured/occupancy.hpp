// The share of each lattice cell inside the solid.
#pragma once

#include "cover/measured/points.hpp"

namespace foam::inline search::cover {

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

} // namespace foam::search::cover
