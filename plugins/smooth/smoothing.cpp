#include "smoothing.hpp"

#include <foam/base/cancellation.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace foam::smooth {

void Laplacian::step(std::vector<Vec3>& points) {
    before_ = points;
    for (std::size_t i = 0; i < points.size(); ++i) {
        points[i] += (around_.mean(before_, i) - before_[i]) * lambda_;
    }
}

void Humphrey::step(std::vector<Vec3>& points) {
    before_ = points;
    away_.resize(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        points[i] = around_.mean(before_, i);
        away_[i] = points[i] - (first_[i] * alpha_ + before_[i] * (1 - alpha_));
    }
    for (std::size_t i = 0; i < points.size(); ++i) {
        points[i] -= away_[i] * beta_ + around_.mean(away_, i) * (1 - beta_);
    }
}

namespace {

/// Moves vertices farther than `reach` from their first positions back to that distance.
void hold_back(std::vector<Vec3>& points, const std::vector<Vec3>& first, double reach) {
    for (std::size_t i = 0; i < points.size(); ++i) {
        const double moved = distance(points[i], first[i]);
        if (moved > reach) {
            points[i] = first[i] + (points[i] - first[i]) * (reach / moved);
        }
    }
}

Vec3 normal(const std::vector<Vec3>& points, const Triangle& t) {
    return cross(points[t[1]] - points[t[0]], points[t[2]] - points[t[0]]);
}

/// Moves vertices of triangles that would be inverted, or lose their area, back to `before`. That may invert other
/// triangles; in the end all vertices may move back. Returns the number of vertices moved back.
std::size_t undo_inversions(std::vector<Vec3>& points, const std::vector<Vec3>& before,
                            const std::vector<Triangle>& triangles) {
    std::vector<char> held(points.size(), 0);
    for (bool changed = true; changed;) {
        changed = false;
        CancellationCounter asking(8192);
        for (const Triangle& t : triangles) {
            asking.check();
            const Vec3 was = normal(before, t);
            if (was == Vec3{} || dot(was, normal(points, t)) > 0) {
                continue;
            }
            for (const std::uint32_t v : t) {
                changed = changed || !held[v];
                held[v] = 1;
                points[v] = before[v];
            }
        }
    }
    return static_cast<std::size_t>(std::count(held.begin(), held.end(), 1));
}

} // namespace

Mesh smoothed(const Mesh& mesh, Method& method, const Limits& limits, Context& context) {
    const bool closed = topology(mesh).closed();
    const double volume = signed_volume(mesh);
    const double reach = limits.move * bounds(mesh).diagonal();
    Mesh result = mesh, next = mesh;
    int done = 0;
    std::size_t held = 0;
    for (; done < limits.iterations; ++done) {
        context.check_cancelled();
        method.step(next.vertices);
        hold_back(next.vertices, mesh.vertices, reach);
        held += undo_inversions(next.vertices, result.vertices, mesh.triangles);
        if (closed && !(std::abs(signed_volume(next) - volume) <= limits.volume_change * std::abs(volume))) {
            context.log(
                Severity::info,
                fmt::format("smoothing ended after {} of {} iterations: the next would change the volume by more "
                            "than {:g} %; the mesh is too coarse for more",
                            done, limits.iterations, 100 * limits.volume_change));
            break;
        }
        result.vertices = next.vertices;
    }
    context.metric("iterations", done, "1");
    context.metric("moves_undone", static_cast<double>(held), "1");
    return result;
}

} // namespace foam::smooth
