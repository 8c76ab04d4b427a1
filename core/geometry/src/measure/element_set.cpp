#include "measure/element_set.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/base/parallel.hpp>
#include <foam/base/random.hpp>

namespace foam::inline geometry {
namespace {

/// Returns the box around the intersections of any two boxes.
Box around_intersections(const ElementSet& set) {
    Box result;
    for (std::size_t i = 0; i < set.size(); ++i) {
        for (std::size_t k = 0; k < i; ++k) {
            const Box &a = set.box(i), &b = set.box(k);
            Box both;
            both.low = {std::max(a.low.x, b.low.x), std::max(a.low.y, b.low.y), std::max(a.low.z, b.low.z)};
            both.high = {std::min(a.high.x, b.high.x), std::min(a.high.y, b.high.y), std::min(a.high.z, b.high.z)};
            if (both.low.x < both.high.x && both.low.y < both.high.y && both.low.z < both.high.z) {
                result.add(both);
            }
        }
    }
    return result;
}

/// A line through each cell of a lattice, at a place in the cell that depends on its indices only.
struct LatticeLines {
    Vec3 anchor, cell;
    int axis;
    long long first_u, first_v;
    std::size_t count_u, count_v;

    LatticeLines(const Vec3& from, const Vec3& size, int along_axis, const Box& region)
        : anchor(from), cell(size), axis(along_axis), first_u(index(region.low, u())), first_v(index(region.low, v())),
          count_u(static_cast<std::size_t>(index(region.high, u()) - first_u + 1)),
          count_v(static_cast<std::size_t>(index(region.high, v()) - first_v + 1)) {}

    int u() const { return (axis + 1) % 3; }
    int v() const { return (axis + 2) % 3; }
    long long index(const Vec3& p, int coordinate) const {
        return static_cast<long long>(std::floor((p[coordinate] - anchor[coordinate]) / cell[coordinate]));
    }
    double low_u(std::size_t row) const {
        return anchor[u()] + cell[u()] * static_cast<double>(first_u + static_cast<long long>(row));
    }
    Vec3 origin(std::size_t row, std::size_t k) const {
        const long long i = first_u + static_cast<long long>(row), j = first_v + static_cast<long long>(k);
        const auto name = static_cast<std::uint64_t>(i) * 0x9E3779B97F4A7C15u + static_cast<std::uint64_t>(j);
        Random random(derive_seed(3 * name + static_cast<std::uint64_t>(axis), "lattice lines"));
        Vec3 p = anchor;
        p[u()] += cell[u()] * (static_cast<double>(i) + random.uniform());
        p[v()] += cell[v()] * (static_cast<double>(j) + random.uniform());
        return p;
    }
};

/// Returns the cells, enlarged by a power of two until they are at most `most` across the region.
Vec3 coarse_enough(Vec3 cell, const Vec3& region) {
    constexpr double most = 256;
    while (region.x > most * cell.x || region.y > most * cell.y || region.z > most * cell.z) {
        cell *= 2;
    }
    return cell;
}

} // namespace

ElementSet::ElementSet(const Elements& elements) {
    const auto add = [&](const Element& e) {
        if (is_valid(e)) {
            elements_.push_back(e);
            boxes_.push_back(foam::bounds(e));
            all_.add(boxes_.back());
        }
    };
    for (const Element& e : elements) {
        add(e);
    }
}

bool ElementSet::hold(const Vec3& p) const {
    for (std::size_t i = 0; i < elements_.size(); ++i) {
        const Box& b = boxes_[i];
        if (p.x >= b.low.x && p.x <= b.high.x && p.y >= b.low.y && p.y <= b.high.y && p.z >= b.low.z &&
            p.z <= b.high.z && holds(elements_[i], p)) {
            return true;
        }
    }
    return false;
}

void ElementSet::between(int axis, double from, double to, Near& near) const {
    near.clear();
    for (std::uint32_t i = 0; i < boxes_.size(); ++i) {
        if (boxes_[i].low[axis] <= to && boxes_[i].high[axis] >= from) {
            near.push_back(i);
        }
    }
}

double ElementSet::along(const Near& near, const Vec3& origin, int axis, Intervals& result) const {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    result.clear();
    double sum = 0;
    for (const std::uint32_t i : near) {
        const Box& b = boxes_[i];
        if (origin[u] >= b.low[u] && origin[u] <= b.high[u] && origin[v] >= b.low[v] && origin[v] <= b.high[v]) {
            if (const auto part = foam::inside_along(elements_[i], origin, geometry::along(axis))) {
                result.push_back({part->enter, part->leave});
                sum += part->leave - part->enter;
            }
        }
    }
    unite(result);
    return sum;
}

/// The variance is that of collapsed strata, as for a solid's volume (inside_lines.cpp).
Estimate ElementSet::volume(const Vec3& anchor, const Vec3& cell) const {
    Estimate result;
    for (const Element& e : elements_) {
        result.value += foam::volume(e);
    }
    const Box region = around_intersections(*this);
    if (region.empty()) {
        return result;
    }
    const Vec3 coarse = coarse_enough(cell, region.size());
    double overlaps = 0, variance = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const LatticeLines lines(anchor, coarse, axis, region);
        std::vector<Estimate> rows(lines.count_u);
        parallel_for(rows.size(), [&](std::size_t row) {
            Near near;
            Intervals parts;
            between(lines.u(), lines.low_u(row), lines.low_u(row) + coarse[lines.u()], near);
            double last = 0;
            for (std::size_t k = 0; k < lines.count_v && near.size() > 1; ++k) {
                const double sum = along(near, lines.origin(row, k), axis, parts);
                const double twice = parts.empty() ? 0 : sum - length(parts);
                rows[row].value += twice;
                rows[row].error += k % 2 == 1 ? (twice - last) * (twice - last) : 0;
                last = twice;
            }
        });
        const double share = coarse[lines.u()] * coarse[lines.v()] / 3; // each axis is an estimate
        for (const Estimate& row : rows) {
            overlaps += share * row.value;
            variance += share * share * row.error;
        }
    }
    return {result.value - overlaps, std::sqrt(variance)};
}

} // namespace foam::geometry
