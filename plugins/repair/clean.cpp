#include "soup.hpp"

#include <foam/base/error.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace foam::repair {
namespace {

/// Throws if the cube of a length would overflow or vanish.
void check_extents(const Mesh& mesh) {
    const Vec3 size = bounds(mesh).size();
    const double extent = std::max({size.x, size.y, size.z});
    if (!(extent < 1e90)) {
        throw Error(ErrorCode::geometry,
                    "the mesh is too large for its volume to be computed; check the unit of the file and its scale");
    }
    if (!(extent > 1e-90)) {
        throw Error(ErrorCode::geometry, "the mesh has no extent");
    }
}

Triangle sorted(Triangle t) {
    std::sort(t.begin(), t.end());
    return t;
}

/// Returns the triangles without later repeats of the same corners.
std::vector<Triangle> without_repeats(const std::vector<Triangle>& triangles) {
    std::vector<std::pair<Triangle, std::uint32_t>> by_corners;
    by_corners.reserve(triangles.size());
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
        by_corners.emplace_back(sorted(triangles[i]), i);
    }
    std::sort(by_corners.begin(), by_corners.end());
    std::vector<char> keep(triangles.size(), 1);
    for (std::size_t k = 1; k < by_corners.size(); ++k) {
        keep[by_corners[k].second] = by_corners[k].first != by_corners[k - 1].first;
    }
    std::vector<Triangle> result;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        if (keep[i]) {
            result.push_back(triangles[i]);
        }
    }
    return result;
}

} // namespace

Cleaned clean(const Mesh& mesh, Context& context) {
    check_corners(mesh);
    Cleaned result;
    result.all = welded(mesh);
    if (!result.all.triangles.empty()) {
        check_extents(result.all);
    }
    Mesh solid{result.all.vertices, {}};
    for (const Triangle& t : result.all.triangles) {
        if (!is_degenerate(corners(result.all, t))) {
            solid.triangles.push_back(t);
        }
    }
    if (solid.triangles.empty()) {
        throw Error(ErrorCode::geometry, "the mesh has no triangle with an area: there is nothing to make a solid of");
    }
    const std::size_t with_area = solid.triangles.size();
    solid.triangles = without_repeats(solid.triangles);
    if (with_area != mesh.triangles.size()) {
        context.log(Severity::info, fmt::format("{} of {} triangles have no area", mesh.triangles.size() - with_area,
                                                mesh.triangles.size()));
    }
    if (solid.triangles.size() != with_area) {
        context.log(Severity::info, fmt::format("{} triangles repeat others", with_area - solid.triangles.size()));
    }
    result.distinct = solid.triangles.size() == result.all.triangles.size() ? result.all : welded(solid);
    return result;
}

std::optional<Mesh> closed_manifold(const Mesh& given, Context& context) {
    std::optional<Neighbours> around = neighbours(given);
    if (!around) {
        return std::nullopt;
    }
    Mesh mesh = given;
    const Components parts = components(mesh, *around);
    std::vector<char> mixed;
    if (!orient(mesh, *around, parts, mixed)) {
        return std::nullopt;
    }
    const std::size_t added = split_fans(mesh, *around);
    const NestingReport nesting = orient_components(mesh, parts, mixed);
    if (nesting.hollow || !(signed_volume(mesh) > 0) || !topology(mesh).closed_manifold()) {
        return std::nullopt;
    }
    const auto report = [&](std::size_t count, const char* what) {
        if (count > 0) {
            context.log(Severity::info, fmt::format("{} {}", count, what));
        }
    };
    report(static_cast<std::size_t>(std::count(mixed.begin(), mixed.end(), 1)),
           "closed parts had triangles facing either way: made to agree");
    report(nesting.turned, "closed parts faced the wrong way: turned");
    report(nesting.cavities, "closed parts face inwards inside of another: kept as cavities");
    report(added, "vertices added where parts touch in a point");
    return mesh;
}

} // namespace foam::repair
