#include <foam/geometry/internal/surface_runs.hpp>

#include "solid/solid_data.hpp"

#include <foam/base/cancellation.hpp>

#include <numeric>

namespace foam::inline geometry {
namespace {

/// Bits of a place along each axis; codes have three times as many, and are sorted by half of them at a time.
constexpr std::uint32_t place_bits = 8, half_a_code = 3 * place_bits / 2;

/// Spreads the eight lowest bits to every third bit.
std::uint32_t every_third(std::uint32_t x) {
    x = (x | x << 8) & 0x0000F00Fu;
    x = (x | x << 4) & 0x000C30C3u;
    return (x | x << 2) & 0x00249249u;
}

/// Returns a code for each triangle: nearby middles have similar codes.
std::vector<std::uint32_t> morton_codes(const Mesh& surface, const Box& box) {
    const Vec3 size = box.size();
    const double extent = std::max({size.x, size.y, size.z}), last = (1u << place_bits) - 1;
    const double scale = extent > 0 && std::isfinite(extent) ? (last + 1) / (3 * extent) : 0;
    const auto place = [&](double sum, double low) {
        return every_third(static_cast<std::uint32_t>(std::clamp((sum - 3 * low) * scale, 0.0, last)));
    };
    std::vector<std::uint32_t> codes;
    codes.reserve(surface.triangles.size());
    CancellationCounter asking(1 << 16);
    for (const auto& [a, b, c] : surface.triangles) {
        asking.check();
        const Vec3 sum = surface.vertices[a] + surface.vertices[b] + surface.vertices[c];
        codes.push_back(place(sum.x, box.low.x) | place(sum.y, box.low.y) << 1 | place(sum.z, box.low.z) << 2);
    }
    return codes;
}

/// Returns the indices by rising code; of equal codes in order.
std::vector<std::uint32_t> order_by(const std::vector<std::uint32_t>& codes) {
    std::vector<std::uint32_t> order(codes.size()), sorted(codes.size());
    std::iota(order.begin(), order.end(), 0u);
    for (const std::uint32_t shift : {0u, half_a_code}) {
        const auto digit = [&](std::uint32_t i) { return codes[i] >> shift & ((1u << half_a_code) - 1); };
        std::vector<std::uint32_t> next((1u << half_a_code) + 1, 0);
        check_cancelled();
        for (const std::uint32_t i : order) {
            ++next[digit(i) + 1];
        }
        check_cancelled();
        std::partial_sum(next.begin(), next.end(), next.begin());
        for (const std::uint32_t i : order) {
            sorted[next[digit(i)]++] = i;
        }
        std::swap(order, sorted);
    }
    return order;
}

/// Returns a ball around balls.
SurfaceRuns::Run around(std::span<const SurfaceRuns::Run> runs) {
    Box box;
    for (const SurfaceRuns::Run& run : runs) {
        box.add(run.center);
    }
    SurfaceRuns::Run all{box.center(), 0};
    for (const SurfaceRuns::Run& run : runs) {
        all.radius = std::max(all.radius, distance(all.center, run.center) + run.radius);
    }
    return all;
}

/// Returns the order of the triangles in runs: along a curve, or in haste as they are given, which is often coherent.
std::vector<std::uint32_t> order_of(const SolidData& data) {
    if (!data.quick) {
        return order_by(morton_codes(*data.surface, data.box));
    }
    std::vector<std::uint32_t> order(data.surface->triangles.size());
    std::iota(order.begin(), order.end(), 0u);
    return order;
}

} // namespace

SurfaceRuns::SurfaceRuns(const SolidData& data)
    : order_(order_of(data)), runs_((order_.size() + length - 1) / length) {
    const Vec3 origin = data.box.center();
    const std::vector<Vec3>& vertices = data.surface->vertices;
    for (const Vec3& v : vertices) {
        extent_ = std::max(extent_, norm(v - origin));
    }
    std::vector<char> curved;
    for (std::size_t i = 0; i < data.parts.size(); ++i) {
        if (data.parts[i].primitive && kind_of(*data.parts[i].primitive).has_known_surface()) {
            curved.resize(order_.size(), 0);
            std::fill(curved.begin() + data.offsets[i], curved.begin() + data.offsets[i + 1], 1);
        }
    }
    CancellationCounter asking(1024);
    for (std::size_t run = 0; run < runs_.size(); ++run) {
        asking.check();
        Box box;
        for (const std::uint32_t i : triangles(run)) {
            for (const std::uint32_t corner : data.surface->triangles[i]) {
                box.add(vertices[corner] - origin);
            }
        }
        const Vec3 center = box.center();
        double squared = 0;
        for (const std::uint32_t i : triangles(run)) {
            for (const std::uint32_t corner : data.surface->triangles[i]) {
                squared = std::max(squared, squared_norm(vertices[corner] - origin - center));
            }
            if (!curved.empty() && curved[i]) {
                squared = std::numeric_limits<double>::infinity();
            }
        }
        runs_[run] = {center, std::sqrt(squared)};
    }
    for (std::size_t first = 0; first < runs_.size(); first += group_length) {
        groups_.push_back(around(std::span(runs_).subspan(first, std::min(group_length, runs_.size() - first))));
    }
}

const SurfaceRuns& surface_runs(const Solid& solid) {
    const SolidData& data = SolidAccess::data(solid);
    std::call_once(data.runs_once, [&] { data.runs = std::make_unique<const SurfaceRuns>(data); });
    return *data.runs;
}

} // namespace foam::inline geometry
