// Volumes of unions of convex elements, alone and with a solid.
#include "measure/element_set.hpp"
#include "solid/inside_lines.hpp"

#include <foam/base/parallel.hpp>
#include <foam/geometry/measure.hpp>
#include <foam/geometry/volumes.hpp>

#include <algorithm>
#include <limits>

namespace foam::inline geometry {
namespace {

/// Lines per side across the box that a lattice is made for.
constexpr double lattice_lines = 64;

Vec3 cell_for(const Box& box) {
    const double least = 1e-6 * box.diagonal(); // a flat box
    const Vec3 size = box.size() / lattice_lines;
    return {std::max(size.x, least), std::max(size.y, least), std::max(size.z, least)};
}

} // namespace

Estimate volume_of_union(const ElementSet& set, const Box& lattice) {
    return set.volume(lattice.low, cell_for(lattice));
}

double missing_of(const Solid& solid, const ElementSet& set) {
    const InsideLines& lines = inside_lines(solid);
    std::vector<double> rows(lines.rows());
    parallel_for(rows.size(), [&](std::size_t row) {
        Intervals in_elements, outside;
        const int axis = lines.axis(row), beside = (axis + 1) % 3;
        double from = std::numeric_limits<double>::infinity(), to = -from; // of the row, across its lines
        for (std::size_t line = 0; line < lines.across(); ++line) {
            from = std::min(from, lines.origin(row, line)[beside]);
            to = std::max(to, lines.origin(row, line)[beside]);
        }
        ElementSet::Near near;
        set.between(beside, from, to, near);
        for (std::size_t line = 0; line < lines.across(); ++line) {
            const auto inside = lines.inside(row, line);
            if (!inside.empty()) {
                set.along(near, lines.origin(row, line), axis, in_elements);
                without(inside, in_elements, lines.shortest(), outside);
                rows[row] += length(outside);
            }
        }
    });
    double sum = 0;
    for (std::size_t row = 0; row < rows.size(); ++row) {
        sum += lines.share(row) * rows[row];
    }
    return sum;
}

double union_volume(const Elements& elements, std::size_t directions) {
    if (elements.are_spheres()) {
        return quick_union_volume(elements.spheres(), directions);
    }
    if (elements.size() == 1) {
        const Element& one = elements.shaped().front();
        return is_valid(one) ? volume(one) : 0;
    }
    const ElementSet set(elements);
    return set.size() == 0 ? 0 : volume_of_union(set, set.bounds()).value;
}

double missing_volume(const Solid& solid, const Elements& elements) {
    return elements.are_spheres() ? solid.missing_volume(elements.spheres()) : missing_of(solid, ElementSet(elements));
}

double excess_volume(const Solid& solid, const Elements& elements) {
    return excess_and_missing_volume(solid, elements).first;
}

std::pair<double, double> excess_and_missing_volume(const Solid& solid, const Elements& elements) {
    if (elements.are_spheres()) {
        const double missing = solid.missing_volume(elements.spheres());
        return {std::max(0.0, exact_union_volume(elements.spheres()) + missing - solid.volume()), missing};
    }
    const ElementSet set(elements);
    const double volume = volume_of_union(set, solid.bounds()).value, missing = missing_of(solid, set);
    return {std::max(0.0, volume - solid.volume() + missing), missing};
}

} // namespace foam::geometry
