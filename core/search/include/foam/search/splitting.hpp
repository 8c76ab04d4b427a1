// One sphere more, without more excess volume.
#pragma once

#include <foam/geometry/solid.hpp>
#include <foam/geometry/sphere.hpp>

#include <memory>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] search {
namespace cover {

/// Spheres and the joint volume of them and a solid, m³.
struct Claim {
    std::vector<Sphere> spheres;
    double volume;
};

/// Covering spheres of a solid that grow by one sphere at a time, whatever their source.
class Splitting {
public:
    /// The solid must outlive this.
    explicit Splitting(const Solid& solid);
    ~Splitting();

    /// Returns one sphere more. `cover` has the joint volume `volume` and covers the solid's surface. The result covers
    /// it too, up to rounding in single precision, which grown_to_cover() closes. One of the spheres becomes two that
    /// contain the part that the others do not cover, separated by a plane. It is the best of those with most excess
    /// volume if that reduces the volume, else of the next ones. If none does (around a ring two spheres have more
    /// volume than one), it is the best of all. Returns `cover` itself if no sphere can be split.
    Claim one_more(const std::vector<Sphere>& cover, double volume);

private:
    struct Data;
    std::unique_ptr<Data> data_;
};

} // namespace cover
} // namespace search
} // namespace foam
