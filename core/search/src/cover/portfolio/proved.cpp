#include "cover/portfolio/proved.hpp"

#include <foam/geometry/volumes.hpp>

namespace foam::inline search::cover {

Ball smallest_ball(const Solid& solid, const Frame& frame) {
    return unit_ball(minimum_enclosing_sphere(solid.surface().vertices), frame);
}

std::vector<Sphere> with_a_hair_of_overlap(const Frame& frame, const Balls& balls) {
    constexpr double overlap = 2e-5;         // share of the radius
    const double margin = 2e-6 * frame.unit; // rounding of centres when they are written is less
    std::vector<Sphere> spheres;
    for (const Ball& b : balls) {
        if (b.r > 0 || (&b == &balls.back() && spheres.empty())) {
            spheres.push_back({frame.from_unit({b.x, b.y, b.z}), b.r * (1 + overlap) * frame.unit + margin});
        }
    }
    return spheres;
}

Cover proved(const Solid& solid, const Frame& frame, const Balls& balls) {
    Cover cover{with_a_hair_of_overlap(frame, balls), {}, 0};
    cover.certificate = certify(solid, cover.spheres);
    if (!cover.certificate.holds) {
        cover.spheres = grown_to_cover(solid, std::move(cover.spheres));
        cover.certificate = certify(solid, cover.spheres);
    }
    cover.volume = exact_union_volume(cover.spheres);
    return cover;
}

} // namespace foam::search::cover
