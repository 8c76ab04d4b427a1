// Bounding-volume hierarchies along a space-filling curve.
#include <foam/base/cancellation.hpp>
#include <foam/geometry/internal/bvh.hpp>

#include <algorithm>
#include <bit>
#include <numeric>

namespace foam::inline geometry {
namespace {

/// Positions along each axis: 3 · 21 bits fill a word. With them a path takes at most 63 cuts, and 32 more where codes
/// are equal.
constexpr double places = 1u << 21;
static_assert(Bvh::max_depth > 63 + 32);

struct Coded {
    std::uint64_t code;
    std::uint32_t index;

    bool operator<(const Coded& other) const { return code != other.code ? code < other.code : index < other.index; }
};

/// Spreads the 21 lowest bits to every third bit.
std::uint64_t spread(std::uint64_t x) {
    x = (x | x << 32) & 0x001F00000000FFFFu;
    x = (x | x << 16) & 0x001F0000FF0000FFu;
    x = (x | x << 8) & 0x100F00F00F00F00Fu;
    x = (x | x << 4) & 0x10C30C30C30C30C3u;
    x = (x | x << 2) & 0x1249249249249249u;
    return x;
}

/// Sorts items that are in order of their indices. Many are sorted digit by digit, which keeps equal ones in order.
void sort_by_code(std::vector<Coded>& items) {
    constexpr std::size_t many = 4096;
    constexpr std::uint32_t digit_bits = 11, code_bits = 63;
    if (items.size() < many) {
        std::sort(items.begin(), items.end());
        return;
    }
    std::vector<Coded> sorted(items.size());
    for (std::uint32_t shift = 0; shift < code_bits; shift += digit_bits) {
        const auto digit = [&](const Coded& item) { return item.code >> shift & ((1u << digit_bits) - 1); };
        std::vector<std::uint32_t> next((1u << digit_bits) + 1, 0);
        for (const Coded& item : items) {
            ++next[digit(item) + 1];
        }
        std::partial_sum(next.begin(), next.end(), next.begin());
        for (const Coded& item : items) {
            sorted[next[digit(item)]++] = item;
        }
        std::swap(items, sorted);
        check_cancelled();
    }
}

std::vector<Coded> along_curve(std::span<const Box> boxes) {
    Box centers;
    for (const Box& box : boxes) {
        centers.add(box.center());
    }
    const Vec3 size = centers.size();
    const double extent = std::max({size.x, size.y, size.z});
    const double scale = extent > 0 ? places / extent : 0;
    const auto place = [&](double offset) {
        return spread(static_cast<std::uint64_t>(std::clamp(offset * scale, 0.0, places - 1)));
    };
    std::vector<Coded> result;
    result.reserve(boxes.size());
    CancellationCounter asking(1 << 16);
    for (std::uint32_t i = 0; i < boxes.size(); ++i) {
        asking.check();
        const Vec3 p = boxes[i].center() - centers.low;
        result.push_back({place(p.x) | place(p.y) << 1 | place(p.z) << 2, i});
    }
    sort_by_code(result);
    return result;
}

/// Returns where the highest differing bit changes; the middle if none does.
std::uint32_t cut(const std::vector<Coded>& items, std::uint32_t begin, std::uint32_t end) {
    const std::uint64_t differing = items[begin].code ^ items[end - 1].code;
    if (differing == 0) {
        return begin + (end - begin) / 2;
    }
    const std::uint64_t bit = std::bit_floor(differing);
    const auto middle = std::partition_point(items.begin() + begin, items.begin() + end,
                                             [&](const Coded& item) { return (item.code & bit) == 0; });
    return static_cast<std::uint32_t>(middle - items.begin());
}

} // namespace

Bvh Bvh::quick(std::span<const Box> boxes, std::uint32_t leaf_size) {
    Bvh result;
    if (boxes.empty()) {
        return result;
    }
    const std::vector<Coded> items = along_curve(boxes);
    std::vector<BvhNode>& nodes = result.nodes_;
    nodes.reserve(2 * boxes.size() / leaf_size + 2);
    nodes.push_back({{}, {}, 0, static_cast<std::uint32_t>(items.size())});
    CancellationCounter asking(4096);
    for (std::size_t n = 0; n < nodes.size(); ++n) { // a node is a leaf until it is cut
        asking.check();
        const std::uint32_t begin = nodes[n].first, end = begin + nodes[n].count;
        if (end - begin > leaf_size) {
            const std::uint32_t middle = cut(items, begin, end);
            nodes[n].first = static_cast<std::uint32_t>(nodes.size());
            nodes[n].count = 0;
            nodes.push_back({{}, {}, begin, middle - begin});
            nodes.push_back({{}, {}, middle, end - middle});
        }
    }
    check_cancelled();
    result.order_.reserve(items.size());
    for (const Coded& item : items) {
        result.order_.push_back(item.index);
    }
    for (std::size_t n = nodes.size(); n-- > 0;) { // children come after their parents
        asking.check();
        BvhNode& node = nodes[n];
        Box box;
        if (node.leaf()) {
            for (std::uint32_t k = node.first; k < node.first + node.count; ++k) {
                box.add(boxes[result.order_[k]]);
            }
        } else {
            for (const std::uint32_t child : {node.first, node.first + 1}) {
                box.add(Box{nodes[child].low, nodes[child].high});
            }
        }
        node.low = box.low;
        node.high = box.high;
    }
    return result;
}

} // namespace foam::geometry
