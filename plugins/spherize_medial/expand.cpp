#include "optimise.hpp"

#include <foam/base/cancellation.hpp>

#include <algorithm>

namespace foam::medial {
namespace {

/// Returns the number of set bits, by operations that compilers vectorise (the portable baseline has no instruction for
/// it).
std::uint64_t set_bits(std::uint64_t x) {
    x -= (x >> 1) & 0x5555555555555555u;
    x = (x & 0x3333333333333333u) + ((x >> 2) & 0x3333333333333333u);
    x = (x + (x >> 4)) & 0x0F0F0F0F0F0F0F0Fu;
    x += x >> 8;
    x += x >> 16;
    x += x >> 32;
    return x & 0x7F;
}

} // namespace

Expand::Expand(std::span<const Vec3> points, std::span<const Sphere> medial)
    : points_(points.size()), medial_(medial.begin(), medial.end()), gap_(points.size() * medial.size()) {
    greatest_ = std::numeric_limits<double>::infinity();
    for (std::size_t m = 0; m < medial_.size(); ++m) {
        check_cancelled();
        float* row = gap_.data() + m * points_;
        float worst = 0;
        for (std::size_t p = 0; p < points_; ++p) {
            row[p] = static_cast<float>(distance(points[p], medial_[m].center) - medial_[m].radius);
            worst = std::max(worst, row[p]);
        }
        greatest_ = std::min(greatest_, static_cast<double>(worst));
    }
}

/// Returns a greedy set cover (Johnson 1974), ties to the first; empty if some points are out of reach of all balls.
Expand::Chosen Expand::greedy(double stand_off) const {
    const std::size_t words = (points_ + 63) / 64;
    const auto reach = static_cast<float>(stand_off);
    std::vector<std::uint64_t> held(words * medial_.size(), 0), open(words, ~std::uint64_t{0});
    if (points_ % 64 != 0) {
        open.back() = (std::uint64_t{1} << (points_ % 64)) - 1;
    }
    for (std::size_t m = 0; m < medial_.size(); ++m) {
        const float* row = gap_.data() + m * points_;
        for (std::size_t w = 0; w < words; ++w) {
            const std::size_t first = w * 64, count = std::min<std::size_t>(64, points_ - first);
            std::uint64_t bits = 0;
            for (std::size_t b = 0; b < count; ++b) {
                bits |= static_cast<std::uint64_t>(row[first + b] <= reach) << b;
            }
            held[m * words + w] = bits;
        }
    }
    Chosen chosen;
    std::size_t left = points_;
    // The contribution of a sphere only falls as others are chosen: an old value is an upper bound (lazy greedy, Minoux
    // 1978).
    std::vector<std::size_t> bound(medial_.size(), points_);
    while (left > 0) {
        check_cancelled();
        std::size_t best = medial_.size(), most = 0;
        for (std::size_t m = 0; m < medial_.size(); ++m) {
            if (bound[m] <= most) {
                continue;
            }
            std::size_t adds = 0;
            for (std::size_t w = 0; w < words; ++w) {
                adds += set_bits(held[m * words + w] & open[w]);
            }
            bound[m] = adds;
            if (adds > most) {
                most = adds;
                best = m;
            }
        }
        if (best == medial_.size()) {
            return {};
        }
        chosen.push_back(static_cast<std::uint32_t>(best));
        for (std::size_t w = 0; w < words; ++w) {
            open[w] &= ~held[best * words + w];
        }
        left -= most;
    }
    return chosen;
}

std::vector<Sphere> Expand::cover(std::size_t count) {
    if (medial_.empty() || count == 0) {
        return {};
    }
    const auto at = [&](double stand_off) -> const Chosen& {
        const auto known = known_.find(stand_off);
        return known != known_.end() ? known->second : known_.emplace(stand_off, greedy(stand_off)).first->second;
    };
    double low = 0, high = greatest_ * (1 + 1e-6) + 1e-9;
    const Chosen* best = &at(high);
    for (int step = 0; step < 9; ++step) {
        check_cancelled();
        const double middle = (low + high) / 2;
        const Chosen& chosen = at(middle);
        if (!chosen.empty() && chosen.size() <= count) {
            best = &chosen;
            high = middle;
        } else {
            low = middle;
        }
    }
    std::vector<Sphere> balls;
    for (const std::uint32_t m : *best) {
        balls.push_back({medial_[m].center, medial_[m].radius + high});
    }
    return balls;
}

} // namespace foam::medial
