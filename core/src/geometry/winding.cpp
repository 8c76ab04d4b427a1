// Fast winding numbers (Barill, Dickson, Schmidt, Levin, Jacobson 2018): far clusters of triangles act as one dipole
// with a first correction.
#include "geometry/mesh_part.hpp"

#include <numbers>

namespace foam::geometry {
namespace {

/// A cluster counts as far beyond this many of its radii. With the second-order term the error of the winding number is
/// then below about 1e-3.
constexpr double far_factor = 2.5;

} // namespace

void MeshPart::compute_moments() {
    const std::vector<BvhNode>& nodes = bvh_.nodes();
    moments_.assign(nodes.size(), {});
    std::vector<std::pair<std::uint32_t, std::uint32_t>> range(nodes.size()); // of items below a node
    for (std::size_t n = nodes.size(); n-- > 0;) {                            // children come behind their parents
        const BvhNode& node = nodes[n];
        range[n] = node.leaf() ? std::pair{node.first, node.first + node.count}
                               : std::pair{range[node.first].first, range[node.first + 1].second};
        Moments& m = moments_[n];
        double weight = 0;
        Vec3 sum{};
        const Vec3 middle = (node.low + node.high) * 0.5;
        for (std::uint32_t i = range[n].first; i < range[n].second; ++i) {
            const auto& [a, b, c] = items_[i].corners;
            if (items_[i].counts) {
                const Vec3 normal = cross(b - a, c - a) * 0.5;
                const double area = norm(normal);
                weight += area;
                sum += ((a - middle) + (b - middle) + (c - middle)) * (area / 3);
                m.normal += normal;
                m.none = false;
            }
        }
        m.center = weight > 0 ? middle + sum / weight : middle;
        for (std::uint32_t i = range[n].first; i < range[n].second; ++i) {
            const auto& [a, b, c] = items_[i].corners;
            if (items_[i].counts) {
                const Vec3 normal = cross(b - a, c - a) * 0.5;
                const Vec3 r = ((a - m.center) + (b - m.center) + (c - m.center)) / 3;
                m.second[0] += normal.x * r.x;
                m.second[1] += normal.y * r.y;
                m.second[2] += normal.z * r.z;
                m.second[3] += normal.x * r.y + normal.y * r.x;
                m.second[4] += normal.y * r.z + normal.z * r.y;
                m.second[5] += normal.z * r.x + normal.x * r.z;
                m.radius = std::max({m.radius, distance(a, m.center), distance(b, m.center), distance(c, m.center)});
            }
        }
        m.trace = m.second[0] + m.second[1] + m.second[2];
    }
}

double MeshPart::winding_by_expansion(const Vec3& p) const {
    const std::vector<BvhNode>& nodes = bvh_.nodes();
    double near = 0, far = 0;
    std::array<std::uint32_t, Bvh::max_depth> stack;
    std::size_t size = 0;
    stack[size++] = 0;
    while (size > 0) {
        const std::uint32_t n = stack[--size];
        const BvhNode& node = nodes[n];
        if (!moments_.empty()) {
            const Moments& m = moments_[n];
            const Vec3 r = m.center - p;
            const double r2 = squared_norm(r);
            if (m.none) {
                continue;
            }
            if (r2 > far_factor * far_factor * m.radius * m.radius) {
                const double inverse3 = 1 / (r2 * std::sqrt(r2));
                const double quadratic = m.second[0] * r.x * r.x + m.second[1] * r.y * r.y + m.second[2] * r.z * r.z +
                                         m.second[3] * r.x * r.y + m.second[4] * r.y * r.z + m.second[5] * r.z * r.x;
                far += (dot(m.normal, r) + m.trace - 3 * quadratic / r2) * inverse3;
                continue;
            }
        }
        if (!node.leaf()) {
            stack[size++] = node.first + 1;
            stack[size++] = node.first;
            continue;
        }
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
            near += items_[i].counts ? winding_of_triangle(items_[i].corners, p) : 0;
        }
    }
    return near + far / (4 * std::numbers::pi);
}

} // namespace foam::geometry
