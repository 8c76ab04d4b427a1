#include "soup.hpp"

#include <foam/base/cancellation.hpp>

#include <numbers>
#include <numeric>

namespace foam::repair {
namespace {

struct Part {
    std::vector<std::uint32_t> triangles;
    Box box;
    double volume = 0;
    double rounding = 0; ///< largest rounding error of the volume
    bool turn = false;
    int outermost = -1; ///< the outermost part that contains this one
};

std::vector<Part> parts_of(const Mesh& mesh, const Components& components) {
    std::vector<Part> parts(components.count);
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
        Part& part = parts[components.of_triangle[i]];
        part.triangles.push_back(i);
        for (const Vec3& p : corners(mesh, mesh.triangles[i])) {
            part.box.add(p);
        }
    }
    for (Part& part : parts) {
        const Vec3 center = part.box.center();
        for (const std::uint32_t i : part.triangles) {
            const Corners t = corners(mesh, mesh.triangles[i]);
            part.volume += dot(t[0] - center, cross(t[1] - center, t[2] - center)) / 6;
            part.rounding += 4 * std::numeric_limits<double>::epsilon() * distance(t[0], center) *
                             distance(t[1], center) * distance(t[2], center);
        }
    }
    return parts;
}

/// Returns whether `inner`, judged by its box and one of its points, lies inside of `outer`.
bool holds(const Mesh& mesh, const Part& outer, const Part& inner) {
    for (int axis = 0; axis < 3; ++axis) {
        if (!(outer.box.low[axis] < inner.box.low[axis] && inner.box.high[axis] < outer.box.high[axis])) {
            return false;
        }
    }
    const Corners t = corners(mesh, mesh.triangles[inner.triangles.front()]);
    const Vec3 point = (t[0] + t[1] + t[2]) / 3;
    double angle = 0;
    CancellationCounter asking(1024);
    for (const std::uint32_t i : outer.triangles) {
        asking.check();
        angle += solid_angle(corners(mesh, mesh.triangles[i]), point);
    }
    return std::abs(angle) > 2 * std::numbers::pi;
}

/// Returns the parts from the largest box to the smallest: a part comes before those that it contains.
std::vector<std::size_t> from_large_to_small(const std::vector<Part>& parts) {
    std::vector<std::size_t> order(parts.size());
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return parts[a].box.diagonal() > parts[b].box.diagonal(); });
    return order;
}

} // namespace

NestingReport orient_components(Mesh& mesh, const Components& components, const std::vector<char>& mixed) {
    NestingReport report;
    std::vector<Part> parts = parts_of(mesh, components);
    const std::vector<std::size_t> order = from_large_to_small(parts);
    for (std::size_t k = 0; k < order.size(); ++k) {
        check_cancelled();
        Part& part = parts[order[k]];
        const double size = part.box.diagonal();
        // Spikes and needles fill little of their box.
        report.hollow |= !(std::abs(part.volume) > std::min(1e-12 * size * size * size, part.rounding));
        int winding = 0; // of the larger parts, at this one
        for (std::size_t j = 0; j < k; ++j) {
            const Part& other = parts[order[j]];
            if (holds(mesh, other, part)) {
                winding += (other.volume > 0) != other.turn ? 1 : -1;
                if (part.outermost < 0) {
                    part.outermost = other.outermost < 0 ? static_cast<int>(order[j]) : other.outermost;
                }
            }
        }
        const bool outward = part.volume > 0;
        if (mixed[order[k]]) {
            part.turn = !outward;
            continue;
        }
        const bool turned_with = part.outermost >= 0 && !mixed[static_cast<std::size_t>(part.outermost)] &&
                                 parts[static_cast<std::size_t>(part.outermost)].turn;
        const bool faces_outward = outward != turned_with;
        part.turn = faces_outward || winding > 0 ? turned_with : !turned_with;
        report.cavities += (outward == part.turn);
    }
    for (const Part& part : parts) {
        report.turned += part.turn;
        for (const std::uint32_t i : part.triangles) {
            if (part.turn) {
                std::swap(mesh.triangles[i][1], mesh.triangles[i][2]);
            }
        }
    }
    return report;
}

} // namespace foam::repair
