#include <foam/geometry/clip_plane.hpp>

#include <foam/base/error.hpp>
#include <foam/base/text.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace foam::inline geometry {

namespace {

std::string name_of(const ClipPlane& plane, std::size_t number) {
    return fmt::format("plane {} of 'clip' ({})", number, text_of(plane));
}

} // namespace

double reach_beyond(const ClipPlane& plane, const Sphere& sphere) {
    return dot(normalized(plane.normal), sphere.center) + sphere.radius - plane.offset;
}

double reach_beyond(const ClipPlane& plane, const Elements& elements) {
    double most = -std::numeric_limits<double>::infinity();
    for (const Sphere& sphere : elements.spheres()) {
        most = std::max(most, reach_beyond(plane, sphere));
    }
    const Vec3 normal = normalized(plane.normal);
    for (const Element& element : elements.shaped()) {
        most = std::max(most, dot(normal, support(element, normal)) - plane.offset);
    }
    return most;
}

std::string text_of(const ClipPlane& plane) {
    const Vec3& n = plane.normal;
    return fmt::format("normal [{}, {}, {}], offset {} m", number_text(n.x), number_text(n.y), number_text(n.z),
                       number_text(plane.offset));
}

ClipPlane seen_from(const ClipPlane& plane, const Pose& pose) {
    ClipPlane seen = plane;
    seen.normal = pose.inverse().rotate(plane.normal);
    seen.offset -= dot(normalized(plane.normal), pose.translation);
    return seen;
}

void require_within(const Solid& solid, const Pose& pose, const std::vector<ClipPlane>& planes) {
    for (std::size_t i = 0; i < planes.size(); ++i) {
        double most = -std::numeric_limits<double>::infinity();
        for (const Vec3& vertex : solid.surface().vertices) {
            most = std::max(most, reach_beyond(planes[i], Sphere{pose * vertex, 0}));
        }
        if (most >= planes[i].reach) {
            throw Error(ErrorCode::geometry,
                        fmt::format("the geometry itself reaches {:.4g} m beyond {}, and spheres may reach {} m beyond "
                                    "it; remedy: raise the plane's offset, or its reach to more than {:.4g}",
                                    most, name_of(planes[i], i + 1), number_text(planes[i].reach), most));
        }
    }
}

double violation_of(const std::vector<ClipPlane>& planes, const Elements& elements) {
    double most = -std::numeric_limits<double>::infinity();
    for (const ClipPlane& plane : planes) {
        most = std::max(most, reach_beyond(plane, elements) - plane.reach);
    }
    return most;
}

std::vector<PlaneReach> reached(const std::vector<ClipPlane>& planes, const Elements& elements) {
    std::vector<PlaneReach> result;
    for (const ClipPlane& plane : planes) {
        result.push_back({plane, reach_beyond(plane, elements)});
    }
    return result;
}

std::vector<std::string> not_kept(const std::vector<PlaneReach>& planes) {
    std::vector<std::string> sentences;
    for (std::size_t i = 0; i < planes.size(); ++i) {
        if (!planes[i].kept()) {
            sentences.push_back(fmt::format("its spheres reach {:.4g} m beyond {}, reach allows {} m; remedy: "
                                            "refine.clip after the spherizer, more spheres for the robot or for this "
                                            "link, or a larger reach",
                                            planes[i].reached, name_of(planes[i].plane, i + 1),
                                            number_text(planes[i].plane.reach)));
        }
    }
    return sentences;
}

} // namespace foam::geometry
