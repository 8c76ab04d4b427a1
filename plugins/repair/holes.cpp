#include "soup.hpp"

#include <foam/base/cancellation.hpp>

#include <algorithm>
#include <limits>
#include <map>

namespace foam::repair {
namespace {

using Loop = std::vector<std::uint32_t>;

constexpr std::size_t most_edges = 500;
/// Largest deviation from a plane of a flat loop, as a share of the loop's extent.
constexpr double flatness = 1e-4;

/// Returns the boundary loops of the holes, in the direction of triangles that fill them. Loops that touch in a vertex
/// are separate.
std::vector<Loop> loops_of(const Mesh& mesh) {
    std::multimap<std::uint32_t, std::uint32_t> next;
    for (const OpenSide& side : open_sides(mesh)) {
        next.emplace(side.to, side.from);
    }
    std::vector<Loop> loops;
    while (!next.empty()) {
        Loop path{next.begin()->first};
        for (auto step = next.find(path.back()); step != next.end(); step = next.find(path.back())) {
            const std::uint32_t to = step->second;
            next.erase(step);
            const auto earlier = std::find(path.begin(), path.end(), to);
            if (earlier != path.end()) {
                loops.emplace_back(earlier, path.end());
                path.erase(earlier, path.end());
            }
            path.push_back(to);
        }
    }
    return loops;
}

bool is_flat(const Mesh& mesh, const Loop& loop, double extent) {
    Vec3 normal, center;
    for (const std::uint32_t v : loop) {
        center += mesh.vertices[v] / static_cast<double>(loop.size());
    }
    for (std::size_t i = 0; i < loop.size(); ++i) {
        normal += cross(mesh.vertices[loop[i]] - center, mesh.vertices[loop[(i + 1) % loop.size()]] - center);
    }
    normal = normalized(normal);
    return norm(normal) > 0 && std::all_of(loop.begin(), loop.end(), [&](std::uint32_t v) {
               return std::abs(dot(mesh.vertices[v] - center, normal)) <= flatness * extent;
           });
}

/// Least-area triangulation by dynamic programming over the polygons i … k of the loop.
class LeastArea {
public:
    LeastArea(const Mesh& mesh, const Loop& loop)
        : mesh_(mesh), loop_(loop), n_(loop.size()), area_(n_ * n_, 0), tip_(n_ * n_, 0) {}

    std::vector<Triangle> run(Context& context) {
        for (std::size_t span = 2; span < n_; ++span) {
            check_cancelled();
            context.check_cancelled();
            for (std::size_t i = 0; i + span < n_; ++i) {
                choose_tip(i, i + span);
            }
        }
        std::vector<Triangle> triangles;
        std::vector<std::pair<std::size_t, std::size_t>> open{{0, n_ - 1}};
        while (!open.empty()) {
            const auto [i, k] = open.back();
            open.pop_back();
            if (k - i >= 2) {
                const std::size_t tip = tip_[i * n_ + k];
                triangles.push_back({loop_[i], loop_[tip], loop_[k]});
                open.emplace_back(i, tip);
                open.emplace_back(tip, k);
            }
        }
        return triangles;
    }

private:
    void choose_tip(std::size_t i, std::size_t k) {
        double best = std::numeric_limits<double>::infinity();
        for (std::size_t tip = i + 1; tip < k; ++tip) {
            const Vec3& p = mesh_.vertices[loop_[tip]];
            const double area = area_[i * n_ + tip] + area_[tip * n_ + k] +
                                norm(cross(mesh_.vertices[loop_[i]] - p, mesh_.vertices[loop_[k]] - p));
            if (area < best) {
                best = area;
                tip_[i * n_ + k] = tip;
            }
        }
        area_[i * n_ + k] = best;
    }

    const Mesh& mesh_;
    const Loop& loop_;
    std::size_t n_;
    std::vector<double> area_; // twice the area of the best triangulation of corners i … k
    std::vector<std::size_t> tip_;
};

} // namespace

std::size_t fill_holes(Mesh& mesh, double largest, Context& context) {
    std::size_t filled = 0;
    for (const Loop& loop : loops_of(mesh)) {
        check_cancelled();
        Box box;
        for (const std::uint32_t v : loop) {
            box.add(mesh.vertices[v]);
        }
        const bool fits = loop.size() >= 3 && loop.size() <= most_edges;
        if (fits && (box.diagonal() <= largest || is_flat(mesh, loop, box.diagonal()))) {
            const std::vector<Triangle> patch = LeastArea(mesh, loop).run(context);
            mesh.triangles.insert(mesh.triangles.end(), patch.begin(), patch.end());
            ++filled;
        }
    }
    return filled;
}

} // namespace foam::repair
