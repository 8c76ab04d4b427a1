#include "smoothing.hpp"

#include <foam/base/cancellation.hpp>

#include <tuple>

namespace foam::smooth {
namespace {

struct Entry {
    std::uint32_t from, to;
    double weight;
};

/// Returns half the cotangent of the angle at `tip`; 0 where it is obtuse or undefined, so that no weight is negative
/// and the mean stays between the neighbours.
double half_cotangent(const Vec3& tip, const Vec3& a, const Vec3& b) {
    const double sine = norm(cross(a - tip, b - tip));
    const double cosine = dot(a - tip, b - tip);
    return sine > 0 && cosine > 0 ? std::min(cosine / sine, 1e6) / 2 : 0.0;
}

std::vector<Entry> entries(const Mesh& mesh, Weighting weighting) {
    std::vector<Entry> result;
    result.reserve(6 * mesh.triangles.size());
    CancellationCounter asking(8192);
    for (const Triangle& t : mesh.triangles) {
        asking.check();
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t a = t[k], b = t[(k + 1) % 3], tip = t[(k + 2) % 3];
            if (a == b) {
                continue;
            }
            const double weight = weighting == Weighting::uniform
                                      ? 1.0
                                      : half_cotangent(mesh.vertices[tip], mesh.vertices[a], mesh.vertices[b]);
            result.push_back({a, b, weight});
            result.push_back({b, a, weight});
        }
    }
    std::stable_sort(result.begin(), result.end(),
                     [](const Entry& a, const Entry& b) { return std::tie(a.from, a.to) < std::tie(b.from, b.to); });
    return result;
}

} // namespace

Vec3 Neighbourhood::mean(const std::vector<Vec3>& f, std::size_t i) const {
    if (begin[i] == begin[i + 1]) {
        return f[i];
    }
    Vec3 sum;
    for (std::uint32_t k = begin[i]; k < begin[i + 1]; ++k) {
        sum += f[neighbours[k].vertex] * neighbours[k].weight;
    }
    return sum;
}

Neighbourhood neighbourhood(const Mesh& mesh, Weighting weighting) {
    const std::vector<Entry> all = entries(mesh, weighting);
    Neighbourhood result;
    result.begin.reserve(mesh.vertices.size() + 1);
    std::size_t next = 0;
    CancellationCounter asking(4096);
    for (std::uint32_t i = 0; i < mesh.vertices.size(); ++i) {
        asking.check();
        const std::size_t first = result.neighbours.size();
        result.begin.push_back(static_cast<std::uint32_t>(first));
        double sum = 0;
        for (; next < all.size() && all[next].from == i; ++next) {
            const bool again = result.neighbours.size() > first && result.neighbours.back().vertex == all[next].to;
            if (!again) {
                result.neighbours.push_back({all[next].to, 0});
            }
            double& weight = result.neighbours.back().weight;
            weight = weighting == Weighting::uniform ? 1.0 : weight + all[next].weight;
        }
        for (std::size_t k = first; k < result.neighbours.size(); ++k) {
            sum += result.neighbours[k].weight;
        }
        // All angles obtuse or flat: the neighbours have equal weights.
        for (std::size_t k = first; k < result.neighbours.size(); ++k) {
            double& weight = result.neighbours[k].weight;
            weight = sum > 0 ? weight / sum : 1.0 / static_cast<double>(result.neighbours.size() - first);
        }
    }
    result.begin.push_back(static_cast<std::uint32_t>(result.neighbours.size()));
    return result;
}

} // namespace foam::smooth
