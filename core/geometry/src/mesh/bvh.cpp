#include <foam/geometry/internal/bvh.hpp>

#include <foam/base/cancellation.hpp>

#include <array>
#include <bit>

namespace foam::inline geometry {
namespace {

constexpr std::size_t bin_count = 16;
/// Depth at which the heuristic gives way to the median, which halves: 2^32 items end within 32 more levels.
constexpr std::size_t heuristic_depth = 56;

/// A box as its low corner and its negated high corner: growing takes six minima, without a branch.
struct Extent {
    std::array<double, 6> least;

    static Extent empty() {
        constexpr double infinity = std::numeric_limits<double>::infinity();
        return {{infinity, infinity, infinity, infinity, infinity, infinity}};
    }
    static Extent of(const Vec3& low, const Vec3& high) { return {{low.x, low.y, low.z, -high.x, -high.y, -high.z}}; }

    Vec3 low() const { return {least[0], least[1], least[2]}; }
    Vec3 high() const { return {-least[3], -least[4], -least[5]}; }
    void add(const Extent& other) {
        for (std::size_t k = 0; k < 6; ++k) {
            least[k] = other.least[k] < least[k] ? other.least[k] : least[k];
        }
    }
    double half_area() const {
        const Vec3 s = high() - low();
        return s.x * s.y + s.y * s.z + s.z * s.x;
    }
};

struct Item {
    Extent extent;
    std::uint32_t index;

    double center(std::size_t axis) const { return (extent.least[axis] - extent.least[axis + 3]) * 0.5; }
};

/// A cut of a range of items: along `axis`, behind bin `bin`.
struct Cut {
    std::size_t axis = 0, bin = 0;
    bool found = false;
};

/// The items of a range, binned by the position of their centres along an axis.
class Bins {
public:
    void clear() { occupied_ = 0; }
    void add(std::size_t bin, const Extent& extent) {
        const std::uint32_t bit = 1u << bin;
        if ((occupied_ & bit) == 0) { // the first item overwrites the values of a former range
            occupied_ |= bit;
            bins_[bin] = {extent, 1};
            return;
        }
        bins_[bin].extent.add(extent);
        ++bins_[bin].count;
    }

    /// Calls visit(bin, cost) for the cuts behind every occupied bin but the last, ascending.
    template <class Visit> void for_each_cut(Visit visit) {
        std::array<double, bin_count> right_cost; // of the items behind a bin, except the last
        Bin sum{Extent::empty(), 0};
        for (std::uint32_t left = occupied_; left != 0;) {
            const auto bin = static_cast<std::size_t>(std::bit_width(left)) - 1;
            right_cost[bin] = sum.count * sum.extent.half_area();
            sum.add(bins_[bin]);
            left &= ~(1u << bin);
        }
        sum = {Extent::empty(), 0};
        for (std::uint32_t left = occupied_; (left & (left - 1)) != 0; left &= left - 1) {
            const auto bin = static_cast<std::size_t>(std::countr_zero(left));
            sum.add(bins_[bin]);
            visit(bin, sum.count * sum.extent.half_area() + right_cost[bin]);
        }
    }

private:
    struct Bin {
        Extent extent;
        std::uint32_t count;

        void add(const Bin& other) {
            extent.add(other.extent);
            count += other.count;
        }
    };
    static_assert(bin_count <= 32);
    std::uint32_t occupied_ = 0; // one bit for each bin
    std::array<Bin, bin_count> bins_;
};

class Builder {
public:
    Builder(std::span<const Box> boxes, std::uint32_t leaf_size) : leaf_size_(leaf_size) {
        items_.reserve(boxes.size());
        for (std::uint32_t i = 0; i < boxes.size(); ++i) {
            items_.push_back({Extent::of(boxes[i].low, boxes[i].high), i});
        }
        nodes_.reserve(2 * boxes.size() / leaf_size + 2);
        nodes_.emplace_back();
        split(0, 0, static_cast<std::uint32_t>(items_.size()), 0);
    }

    std::vector<BvhNode> take_nodes() { return std::move(nodes_); }
    std::vector<std::uint32_t> order() const {
        std::vector<std::uint32_t> result;
        result.reserve(items_.size());
        for (const Item& item : items_) {
            result.push_back(item.index);
        }
        return result;
    }

private:
    /// Returns the bins per unit. If all centres coincide, the value does not matter: they share one bin.
    static double scale_of(const Extent& centers, std::size_t axis) {
        return bin_count / (-centers.least[axis + 3] - centers.least[axis]);
    }
    static std::size_t bin_of(double value, double low, double scale) {
        const double place = (value - low) * scale; // not negative: `low` is the minimum
        return place < bin_count ? static_cast<std::size_t>(static_cast<int>(place)) : bin_count - 1;
    }

    void split(std::size_t node, std::uint32_t begin, std::uint32_t end, std::size_t depth) {
        constexpr std::uint32_t many = 1000;
        if (end - begin > many) {
            check_cancelled();
        }
        Extent extent = Extent::empty(), centers = Extent::empty();
        for (std::uint32_t i = begin; i < end; ++i) {
            const Vec3 center{items_[i].center(0), items_[i].center(1), items_[i].center(2)};
            extent.add(items_[i].extent);
            centers.add(Extent::of(center, center));
        }
        nodes_[node] = {extent.low(), extent.high(), begin, end - begin};
        if (end - begin <= leaf_size_) {
            return;
        }
        std::uint32_t middle = begin;
        if (depth < heuristic_depth) {
            middle = partition(best_cut(begin, end, centers), begin, end, centers);
        }
        if (middle == begin || middle == end) {
            middle = median(begin, end, centers);
        }
        const std::size_t children = nodes_.size();
        nodes_.resize(children + 2);
        nodes_[node].first = static_cast<std::uint32_t>(children);
        nodes_[node].count = 0;
        split(children, begin, middle, depth + 1);
        split(children + 1, middle, end, depth + 1);
    }

    Cut best_cut(std::uint32_t begin, std::uint32_t end, const Extent& centers) {
        std::array<double, 3> low, scale;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            low[axis] = centers.least[axis];
            scale[axis] = scale_of(centers, axis);
            bins_[axis].clear();
        }
        for (std::uint32_t i = begin; i < end; ++i) {
            for (std::size_t axis = 0; axis < 3; ++axis) {
                bins_[axis].add(bin_of(items_[i].center(axis), low[axis], scale[axis]), items_[i].extent);
            }
        }
        Cut best;
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t axis = 0; axis < 3; ++axis) {
            bins_[axis].for_each_cut([&](std::size_t bin, double cost) {
                if (cost < least) {
                    least = cost;
                    best = {axis, bin, true};
                }
            });
        }
        return best;
    }

    std::uint32_t partition(const Cut& cut, std::uint32_t begin, std::uint32_t end, const Extent& centers) {
        if (!cut.found) {
            return begin;
        }
        const double low = centers.least[cut.axis], scale = scale_of(centers, cut.axis);
        const auto middle = std::partition(items_.begin() + begin, items_.begin() + end, [&](const Item& item) {
            return bin_of(item.center(cut.axis), low, scale) <= cut.bin;
        });
        return static_cast<std::uint32_t>(middle - items_.begin());
    }

    std::uint32_t median(std::uint32_t begin, std::uint32_t end, const Extent& centers) {
        const Vec3 size = centers.high() - centers.low();
        const std::size_t axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        const std::uint32_t middle = begin + (end - begin) / 2;
        std::nth_element(items_.begin() + begin, items_.begin() + middle, items_.begin() + end,
                         [axis](const Item& a, const Item& b) {
                             const double p = a.center(axis), q = b.center(axis);
                             return p != q ? p < q : a.index < b.index;
                         });
        return middle;
    }

    std::uint32_t leaf_size_;
    std::vector<Item> items_;
    std::vector<BvhNode> nodes_;
    std::array<Bins, 3> bins_;
};

} // namespace

Bvh::Bvh(std::span<const Box> boxes, std::uint32_t leaf_size) {
    if (boxes.empty()) {
        return;
    }
    Builder builder(boxes, leaf_size);
    order_ = builder.order();
    nodes_ = builder.take_nodes();
}

} // namespace foam::geometry
