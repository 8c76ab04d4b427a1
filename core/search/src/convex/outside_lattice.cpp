#include "cells.hpp"

#include "by_spheres/measured/points.hpp"

#include <foam/base/hypot.hpp>
#include <foam/geometry/internal/bvh.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace foam::inline search::convex {
namespace {

using Kind = Element::Kind;

/// A fit in the precision of the lattice.
struct Held {
    explicit Held(const Fit& fit, double cell) {
        for (std::size_t k = 0; k < 3; ++k) {
            for (int i = 0; i < 3; ++i) {
                axis[k][i] = static_cast<float>(fit.axes[k][i]);
            }
            offset[k] = static_cast<float>(dot(fit.axes[k], fit.center));
            half[k] = static_cast<float>(fit.half[static_cast<int>(k)]);
        }
        radius = static_cast<float>(fit.radius);
        inverse_cell = static_cast<float>(1 / cell);
        // |d|² - r² is about 2 r times the distance from the surface.
        steepness = static_cast<float>(0.5 / (std::max(fit.radius, cell) * cell));
    }
    float axis[3][3];
    float offset[3], half[3];
    float radius, inverse_cell, steepness;
};

/// Makes each share at least that of the fit.
FOAM_FOR_WIDE_VECTORS
void hold_by_round(const Held& f, std::size_t count, const float* x, const float* y, const float* z, float* held) {
    for (std::size_t i = 0; i < count; ++i) {
        float squared = 0, deep = -std::numeric_limits<float>::infinity();
        for (int k = 0; k < 3; ++k) {
            const float q = std::abs(f.axis[k][0] * x[i] + f.axis[k][1] * y[i] + f.axis[k][2] * z[i] - f.offset[k]);
            const float beyond = std::max(q - f.half[k], 0.0f);
            squared += beyond * beyond;
            deep = std::max(deep, q - f.half[k]);
        }
        // In the core, the distance to its boundary counts: a swept box may have no radius.
        const float distance = std::sqrt(squared) + std::min(deep, 0.0f) - f.radius;
        const float share = std::clamp(0.5f - distance * f.inverse_cell, 0.0f, 1.0f);
        held[i] = std::max(held[i], share);
    }
}

FOAM_FOR_WIDE_VECTORS
void hold_by_box(const Held& f, std::size_t count, const float* x, const float* y, const float* z, float* held) {
    for (std::size_t i = 0; i < count; ++i) {
        float farthest = -1;
        for (int k = 0; k < 3; ++k) {
            const float q = std::abs(f.axis[k][0] * x[i] + f.axis[k][1] * y[i] + f.axis[k][2] * z[i] - f.offset[k]);
            farthest = std::max(farthest, q - f.half[k]);
        }
        const float share = std::clamp(0.5f - farthest * f.inverse_cell, 0.0f, 1.0f);
        held[i] = std::max(held[i], share);
    }
}

FOAM_FOR_WIDE_VECTORS
void hold_by_cylinder(const Held& f, std::size_t count, const float* x, const float* y, const float* z, float* held) {
    for (std::size_t i = 0; i < count; ++i) {
        float q[3];
        for (int k = 0; k < 3; ++k) {
            q[k] = std::abs(f.axis[k][0] * x[i] + f.axis[k][1] * y[i] + f.axis[k][2] * z[i] - f.offset[k]);
        }
        const float side = 0.5f - (q[0] * q[0] + q[1] * q[1] - f.radius * f.radius) * f.steepness;
        const float end = 0.5f - (q[2] - f.half[2]) * f.inverse_cell;
        held[i] = std::max(held[i], std::clamp(std::min(side, end), 0.0f, 1.0f));
    }
}

FOAM_FOR_WIDE_VECTORS
void hold_by_ellipsoid(const Held& f, std::size_t count, const float* x, const float* y, const float* z, float* held) {
    for (std::size_t i = 0; i < count; ++i) {
        float squared = 0, slope = 0; // of the reach, and of its gradient
        for (int k = 0; k < 3; ++k) {
            const float q = f.axis[k][0] * x[i] + f.axis[k][1] * y[i] + f.axis[k][2] * z[i] - f.offset[k];
            const float share = q / f.half[k];
            squared += share * share;
            slope += share * share / (f.half[k] * f.half[k]);
        }
        // (reach² - 1) / |gradient of reach²| is about the distance from the surface.
        const float distance = (squared - 1) / (2 * std::sqrt(slope) + 1e-20f);
        held[i] = std::max(held[i], std::clamp(0.5f - distance * f.inverse_cell, 0.0f, 1.0f));
    }
}

} // namespace

Box bounds(const Fit& fit) {
    Vec3 reach;
    for (int i = 0; i < 3; ++i) {
        reach[i] = fit.kind == Kind::cylinder ? fit.radius * foam::hypot(fit.axes[0][i], fit.axes[1][i])
                   : fit.kind == Kind::box    ? 0
                                              : fit.radius;
        if (fit.kind == Kind::ellipsoid) {
            reach[i] = norm(Vec3{fit.axes[0][i] * fit.half.x, fit.axes[1][i] * fit.half.y, fit.axes[2][i] * fit.half.z});
            continue;
        }
        for (int k = 0; k < 3; ++k) {
            reach[i] += std::abs(fit.axes[static_cast<std::size_t>(k)][i]) * fit.half[k];
        }
    }
    return Box::about(fit.center, reach);
}

double OutsideLattice::outside_solid(const Vec3& p) const {
    constexpr double units = 2; // of the occupancy in one of the body
    return occupancy_.outside(static_cast<float>(units * p.x), static_cast<float>(units * p.y),
                              static_cast<float>(units * p.z));
}

void OutsideLattice::look(std::span<const Fit> others, const Box& region, std::size_t cells) {
    region_ = region;
    const Vec3 size = region.size();
    cell_ = std::cbrt(std::max(size.x, thin) * std::max(size.y, thin) * std::max(size.z, thin) /
                      static_cast<double>(cells));
    std::array<int, 3> count;
    Vec3 low;
    for (int axis = 0; axis < 3; ++axis) {
        const auto at = static_cast<std::size_t>(axis);
        count[at] = std::max(1, static_cast<int>(std::ceil(size[axis] / cell_)));
        low[axis] = region.center()[axis] - (count[at] - 1) * (cell_ / 2);
    }
    const auto longest = static_cast<std::size_t>(std::max_element(count.begin(), count.end()) - count.begin());
    longest_ = static_cast<int>(longest);
    x_.clear(), y_.clear(), z_.clear(), weight_.clear();
    const std::size_t u = (longest + 1) % 3, v = (longest + 2) % 3;
    std::array<int, 3> i{};
    for (i[longest] = 0; i[longest] < count[longest]; ++i[longest]) {
        for (i[v] = 0; i[v] < count[v]; ++i[v]) {
            for (i[u] = 0; i[u] < count[u]; ++i[u]) {
                const Vec3 p = low + Vec3{i[0] * cell_, i[1] * cell_, i[2] * cell_};
                if (const double weight = outside_solid(p); weight > 0) {
                    x_.push_back(static_cast<float>(p.x));
                    y_.push_back(static_cast<float>(p.y));
                    z_.push_back(static_cast<float>(p.z));
                    weight_.push_back(static_cast<float>(weight));
                }
            }
        }
    }
    held_.assign(x_.size(), 0);
    for (const Fit& other : others) {
        if (geometry::overlap(bounds(other), region)) {
            hold(other);
        }
    }
    std::size_t left = 0;
    for (std::size_t i = 0; i < x_.size(); ++i) {
        if (held_[i] < 1) {
            x_[left] = x_[i], y_[left] = y_[i], z_[left] = z_[i];
            weight_[left++] = weight_[i] * (1 - held_[i]);
        }
    }
    x_.resize(left), y_.resize(left), z_.resize(left), weight_.resize(left);
}

void OutsideLattice::hold(const Fit& fit) {
    const std::vector<float>& along = longest_ == 0 ? x_ : longest_ == 1 ? y_ : z_;
    const Box box = bounds(fit);
    const auto low = static_cast<float>(box.low[longest_] - cell_),
               high = static_cast<float>(box.high[longest_] + cell_);
    const auto from = std::lower_bound(along.begin(), along.end(), low);
    const auto first = static_cast<std::size_t>(from - along.begin());
    const auto count = static_cast<std::size_t>(std::upper_bound(from, along.end(), high) - from);
    const Held f(fit, cell_);
    const auto add = fit.kind == Kind::box         ? hold_by_box
                     : fit.kind == Kind::cylinder  ? hold_by_cylinder
                     : fit.kind == Kind::ellipsoid ? hold_by_ellipsoid
                                                   : hold_by_round;
    add(f, count, x_.data() + first, y_.data() + first, z_.data() + first, held_.data() + first);
}

double OutsideLattice::of(std::span<const Fit> elements) {
    held_.assign(x_.size(), 0);
    double beyond = 0;
    for (const Fit& element : elements) {
        hold(element);
        const Box box = bounds(element);
        const Vec3 size = box.size();
        for (int axis = 0; axis < 3; ++axis) {
            const double over =
                std::max(region_.low[axis] - box.low[axis], 0.0) + std::max(box.high[axis] - region_.high[axis], 0.0);
            beyond += over * size[(axis + 1) % 3] * size[(axis + 2) % 3];
        }
    }
    double sum = 0;
    for (std::size_t i = 0; i < x_.size(); ++i) {
        sum += static_cast<double>(held_[i] * weight_[i]);
    }
    return sum * cell_ * cell_ * cell_ + beyond;
}

} // namespace foam::inline search::convex
