#include "geometry/bvh.hpp"

#include <array>

namespace foam::geometry {
namespace {

constexpr std::size_t bin_count = 16;
/// Deeper than this the heuristic gives way to the median, which halves: 2^32 items end within 32 more levels.
constexpr std::size_t heuristic_depth = 56;

struct Item {
    Box box;
    Vec3 center;
    std::uint32_t index;
};

double half_area(const Box& box) {
    const Vec3 s = box.size();
    return s.x * s.y + s.y * s.z + s.z * s.x;
}

/// Where to cut a range of items: along `axis`, behind bin `bin`; no cut if axis < 0.
struct Cut {
    int axis = -1;
    std::size_t bin = 0;
};

class Builder {
public:
    Builder(std::span<const Box> boxes, std::uint32_t leaf_size) : leaf_size_(leaf_size) {
        items_.reserve(boxes.size());
        for (std::uint32_t i = 0; i < boxes.size(); ++i) {
            items_.push_back({boxes[i], boxes[i].center(), i});
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
    static std::size_t bin_of(double value, double low, double scale) {
        return std::min(bin_count - 1, static_cast<std::size_t>(std::max(0.0, (value - low) * scale)));
    }

    void split(std::size_t node, std::uint32_t begin, std::uint32_t end, std::size_t depth) {
        Box box, centers;
        for (std::uint32_t i = begin; i < end; ++i) {
            box.add(items_[i].box);
            centers.add(items_[i].center);
        }
        nodes_[node] = {box.low, box.high, begin, end - begin};
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

    Cut best_cut(std::uint32_t begin, std::uint32_t end, const Box& centers) const {
        struct Bin {
            Box box;
            std::uint32_t count = 0;
        };
        Cut best;
        double least = std::numeric_limits<double>::infinity();
        for (int axis = 0; axis < 3; ++axis) {
            const double extent = centers.high[axis] - centers.low[axis];
            if (!(extent > 0)) {
                continue;
            }
            const double scale = bin_count / extent;
            std::array<Bin, bin_count> bins{};
            for (std::uint32_t i = begin; i < end; ++i) {
                Bin& bin = bins[bin_of(items_[i].center[axis], centers.low[axis], scale)];
                bin.box.add(items_[i].box);
                ++bin.count;
            }
            std::array<double, bin_count> right_cost{};
            Bin sum;
            for (std::size_t b = bin_count - 1; b > 0; --b) {
                sum.box.add(bins[b].box);
                sum.count += bins[b].count;
                right_cost[b - 1] = sum.count * half_area(sum.box);
            }
            sum = {};
            for (std::size_t b = 0; b + 1 < bin_count; ++b) {
                sum.box.add(bins[b].box);
                sum.count += bins[b].count;
                const double cost = sum.count * half_area(sum.box) + right_cost[b];
                if (sum.count > 0 && sum.count < end - begin && cost < least) {
                    least = cost;
                    best = {axis, b};
                }
            }
        }
        return best;
    }

    std::uint32_t partition(const Cut& cut, std::uint32_t begin, std::uint32_t end, const Box& centers) {
        if (cut.axis < 0) {
            return begin;
        }
        const double low = centers.low[cut.axis];
        const double scale = bin_count / (centers.high[cut.axis] - low);
        const auto middle = std::partition(items_.begin() + begin, items_.begin() + end, [&](const Item& item) {
            return bin_of(item.center[cut.axis], low, scale) <= cut.bin;
        });
        return static_cast<std::uint32_t>(middle - items_.begin());
    }

    std::uint32_t median(std::uint32_t begin, std::uint32_t end, const Box& centers) {
        const Vec3 size = centers.size();
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        const std::uint32_t middle = begin + (end - begin) / 2;
        std::nth_element(items_.begin() + begin, items_.begin() + middle, items_.begin() + end,
                         [axis](const Item& a, const Item& b) {
                             return a.center[axis] != b.center[axis] ? a.center[axis] < b.center[axis]
                                                                     : a.index < b.index;
                         });
        return middle;
    }

    std::uint32_t leaf_size_;
    std::vector<Item> items_;
    std::vector<BvhNode> nodes_;
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
