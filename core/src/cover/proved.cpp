#include "cover/proved.hpp"

namespace foam::cover {

Ball smallest_ball(const Solid& solid, const Frame& frame) {
    const Sphere sphere = minimum_enclosing_sphere(solid.surface().vertices);
    return ball_of({frame.to_unit(sphere.center), sphere.radius / frame.unit});
}

Cover proved(const Solid& solid, std::vector<Sphere> spheres) {
    Cover cover{std::move(spheres), {}, 0};
    cover.certificate = certify(solid, cover.spheres);
    if (!cover.certificate.holds) {
        cover.spheres = grown_to_cover(solid, std::move(cover.spheres));
        cover.certificate = certify(solid, cover.spheres);
    }
    return cover;
}

} // namespace foam::cover
