#include "proof/filling.hpp"

#include "convex/kind.hpp"
#include "proof/deepest.hpp"
#include "solid/solid_data.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/base/error.hpp>
#include <foam/geometry/internal/proof.hpp>

#include <algorithm>
#include <limits>

namespace foam::inline geometry {
namespace {

/// A cube of space.
struct Cell {
    Vec3 center;
    double half;

    Box box() const { return Box::about(center, Vec3{half, half, half}); }
    double reach() const { return std::sqrt(3.0) * half; }
    Vec3 corner(int k) const { return center + Vec3{k & 1 ? half : -half, k & 2 ? half : -half, k & 4 ? half : -half}; }
};

/// The cells of a solid that are outside all elements, from large to small.
class Cavity {
public:
    /// `finest`: half the edge of the smallest cells.
    Cavity(const Solid& solid, std::span<const Element> elements, const Cell& region, double finest)
        : data_(SolidAccess::data(solid)), elements_(elements), finest_(finest) {
        std::vector<std::uint32_t> all;
        for (std::uint32_t i = 0; i < elements.size(); ++i) {
            if (is_valid(elements[i])) {
                all.push_back(i);
            }
        }
        look_at(region, all);
    }
    const std::vector<Cell>& cells() const { return cells_; }

private:
    static constexpr std::size_t most_cells = 20'000;

    /// `near`: the elements that may meet the cell.
    void look_at(const Cell& cell, const std::vector<std::uint32_t>& near) {
        asking_.check();
        const double reach = cell.reach();
        bool outside = true; // all elements
        std::vector<std::uint32_t> meeting;
        for (const std::uint32_t i : near) {
            const double away = signed_distance(elements_[i], cell.center);
            if (away < -reach) {
                return;
            }
            if (away <= reach) {
                meeting.push_back(i);
            }
            outside = outside && away > 0;
        }
        const bool small = cell.half <= finest_;
        if (cells_.size() == most_cells || (small && !outside)) {
            return;
        }
        const double inside = -data_.distance_to_filled(cell.center);
        if (inside < -reach || (small && inside <= 0)) {
            return;
        }
        if (small || (meeting.empty() && inside > reach)) {
            cells_.push_back(cell);
            return;
        }
        for (int k = 0; k < 8; ++k) {
            look_at({(cell.center + cell.corner(k)) * 0.5, cell.half / 2}, meeting);
        }
    }

    const SolidData& data_;
    std::span<const Element> elements_;
    double finest_;
    std::vector<Cell> cells_;
    CancellationCounter asking_{64};
};

/// The points that each element is to hold.
class Orders {
public:
    explicit Orders(std::span<const Element> elements) : elements_(elements), points_(elements.size()) {}

    /// Gives points to the one of the nearest elements that adds the least volume.
    void give(std::span<const Vec3> points) {
        constexpr std::size_t compared = 6;
        std::vector<std::pair<double, std::size_t>> order;
        for (std::size_t i = 0; i < elements_.size(); ++i) {
            if (is_valid(elements_[i])) {
                double farthest = -std::numeric_limits<double>::infinity();
                for (const Vec3& p : points) {
                    farthest = std::max(farthest, signed_distance(elements_[i], p));
                }
                order.push_back({farthest, i});
            }
        }
        const std::size_t count = std::min(compared, order.size());
        std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(count), order.end());
        std::size_t best = order.front().second;
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t k = 0; k < count; ++k) {
            const std::size_t i = order[k].second;
            std::vector<Vec3> all = points_[i];
            all.insert(all.end(), points.begin(), points.end());
            const double added = added_volume(elements_[i], all) - added_[i];
            if (added < least) {
                least = added;
                best = i;
            }
        }
        points_[best].insert(points_[best].end(), points.begin(), points.end());
        added_[best] += std::max(least, 0.0);
    }
    /// Returns the elements that hold what was given to them, and all within `room` of it.
    std::vector<Element> filled(double room) const {
        std::vector<Element> result(elements_.begin(), elements_.end());
        for (std::size_t i = 0; i < result.size(); ++i) {
            if (!points_[i].empty()) {
                result[i] = enlarged(result[i], points_[i], room);
            }
        }
        return result;
    }

private:
    std::span<const Element> elements_;
    std::vector<std::vector<Vec3>> points_;
    std::vector<double> added_ = std::vector<double>(points_.size(), 0.0);
};

/// Appends the corners of cells.
void add_corners(std::span<const Cell> cells, std::vector<Vec3>& points) {
    for (const Cell& cell : cells) {
        for (int k = 0; k < 8; ++k) {
            points.push_back(cell.corner(k));
        }
    }
}

/// What is left open of a solid, and the orders that close it.
class Filling {
public:
    Filling(const Solid& solid, std::span<const Element> elements)
        : solid_(solid), data_(SolidAccess::data(solid)), elements_(elements), orders_(elements) {
        const Vec3 size = solid.bounds().size();
        half_ = std::max({size.x, size.y, size.z}) / 2;
    }

    /// `room`: beyond what is given; `overlap`: growth of all where they overlap too little to be looked at in pieces.
    std::vector<Element> closed(const SolidProof& proof, double room, double overlap) {
        constexpr double coarse = 1.0 / 32; // of the size
        constexpr std::size_t most_open = 50;
        if (proof.depth > coarse * half_) {
            const Cavity cavity(solid_, elements_, {solid_.bounds().center(), half_}, coarse * half_);
            for (const Cell& cell : cavity.cells()) {
                points_.clear();
                add_corners(std::span(&cell, 1), points_);
                orders_.give(points_);
            }
            return orders_.filled(room);
        }
        std::vector<Cell> regions;
        for (std::size_t i = 0; i < std::min(most_open, proof.open.size()); ++i) {
            const auto known = [&](const Cell& region) {
                return distance(proof.open[i].points.back(), region.center) < region.half / 2;
            };
            if (std::none_of(regions.begin(), regions.end(), known)) {
                close(proof.open[i], regions);
            }
        }
        std::vector<Element> elements = orders_.filled(room);
        for (Element& e : elements) {
            e = thin_overlap_ && is_valid(e) ? grown(e, overlap) : e;
        }
        return elements;
    }

private:
    /// Closes the cavity at an open part of a surface, around its deepest point that is found.
    void close(const SolidProof::Open& open, std::vector<Cell>& regions) {
        constexpr double wide = 8, fine = 0.5, first_step = 0.02; // of the depth; of half the size
        const double least = least_step * half_;
        const DeepPoint deepest = deepest_from(data_, elements_, open.points.back(), first_step * half_, least);
        points_ = open.points;
        if (deepest.depth > 0) {
            regions.push_back({deepest.point, wide * deepest.depth});
            const Cavity cavity(solid_, elements_, regions.back(), fine * deepest.depth);
            add_corners(cavity.cells(), points_);
        } else if (size_of(open) > least) { // not a place, but a part beyond number
            thin_overlap_ = true;
            return;
        }
        orders_.give(points_);
    }
    static double size_of(const SolidProof::Open& open) {
        Box box;
        for (std::size_t k = 0; k + 1 < open.points.size(); ++k) {
            box.add(open.points[k]);
        }
        return box.diagonal();
    }

    static constexpr double least_step = 1e-6; ///< of half the size
    const Solid& solid_;
    const SolidData& data_;
    std::span<const Element> elements_;
    Orders orders_;
    double half_;
    bool thin_overlap_ = false;
    std::vector<Vec3> points_;
};

/// Returns the elements with one of them grown around the whole solid: the one that is least then.
std::vector<Element> with_one_around(const Solid& solid, std::vector<Element> elements, double room) {
    const std::vector<Vec3>& vertices = solid.surface().vertices;
    Element* best = nullptr;
    double least = std::numeric_limits<double>::infinity();
    for (Element& e : elements) {
        if (is_valid(e)) {
            const double whole = volume(enlarged(e, vertices, room));
            if (!best || whole < least) {
                best = &e;
                least = whole;
            }
        }
    }
    *best = enlarged(*best, vertices, room);
    return elements;
}

double sum_of_volumes(std::span<const Element> elements) {
    double sum = 0;
    for (const Element& e : elements) {
        sum += is_valid(e) ? volume(e) : 0;
    }
    return sum;
}

} // namespace

Elements grown_to_fill(const Solid& solid, Elements given) {
    SolidProof proof = prove_solid(solid, given, true);
    if (proof.holds) {
        return given;
    }
    constexpr int rounds = 14;
    constexpr double least_room = 1e-9, more = 4;               // of the size; from round to round
    constexpr double least_overlap = 4e-6, most_overlap = 1e-3; // of the size
    const double size = solid.bounds().diagonal();
    double room = least_room * size, overlap = least_overlap * size;
    const std::vector<Element> around = with_one_around(solid, {given.begin(), given.end()}, room);
    const double most = sum_of_volumes(around);
    std::vector<Element> elements(given.begin(), given.end());
    for (int round = 0; round < rounds && !proof.holds; ++round) {
        elements = Filling(solid, elements).closed(proof, room, overlap);
        if (sum_of_volumes(elements) > most) {
            return around;
        }
        room *= more;
        overlap = std::min(more * overlap, most_overlap * size);
        proof = prove_solid(solid, elements, true);
    }
    return proof.holds ? Elements(std::move(elements)) : Elements(around);
}

} // namespace foam::inline geometry
