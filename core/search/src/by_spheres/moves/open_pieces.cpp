#include "by_spheres/moves/remainder.hpp"

#include "by_spheres/measured/points.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>

namespace foam::inline search::by_spheres {
namespace {

constexpr std::size_t lanes = 8, most_blocks = 32;

/// Which of up to 256 balls contain a point, one bit for each.
struct Holders {
    alignas(32) std::array<std::uint64_t, 4> bits;
};
bool any_in_all(const Holders& a, const Holders& b, const Holders& c) {
    std::uint64_t all = 0;
    for (std::size_t k = 0; k < a.bits.size(); ++k) {
        all |= a.bits[k] & b.bits[k] & c.bits[k];
    }
    return all != 0;
}

/// Lists of balls, in blocks of eight. The last block of a list is filled up with balls that contain nothing.
struct BlockedBalls {
    std::vector<float> x, y, z, squared_radius;

    void add(const Ball& ball, float squared) {
        x.push_back(ball.x);
        y.push_back(ball.y);
        z.push_back(ball.z);
        squared_radius.push_back(squared);
    }
    void resize(std::size_t size) {
        x.resize(size);
        y.resize(size);
        z.resize(size);
        squared_radius.resize(size);
    }
    std::size_t size() const { return x.size(); }
};

FOAM_FOR_WIDE_VECTORS
void find_holders(const BlockedBalls& balls, std::size_t begin, std::size_t blocks, const PieceCorner& p,
                  Holders& holders) {
    // Hot loop of the search, vectorised by hand: eight balls at a time.
    using Lanes = float __attribute__((vector_size(32)));
    using Bits = std::int32_t __attribute__((vector_size(32)));
    Bits result{};
    for (std::size_t block = 0; block < blocks; ++block) {
        const std::size_t first = begin + block * lanes;
        Lanes x, y, z, most;
        std::memcpy(&x, &balls.x[first], sizeof x);
        std::memcpy(&y, &balls.y[first], sizeof y);
        std::memcpy(&z, &balls.z[first], sizeof z);
        std::memcpy(&most, &balls.squared_radius[first], sizeof most);
        const Lanes dx = x - p.x, dy = y - p.y, dz = z - p.z;
        const Bits contains = dx * dx + dy * dy + dz * dz <= most;
        result |= contains & static_cast<std::int32_t>(1u << block);
    }
    std::memcpy(holders.bits.data(), &result, sizeof result);
}

float squared_length(const PieceCorner& a, const PieceCorner& b) {
    const float dx = a.x - b.x, dy = a.y - b.y, dz = a.z - b.z;
    return dx * dx + dy * dy + dz * dz;
}

PieceCorner middle_of(const PieceCorner& a, const PieceCorner& b) {
    return {(a.x + b.x) / 2, (a.y + b.y) / 2, (a.z + b.z) / 2};
}

/// Divides triangles at their longest edges, with the balls that may matter to each piece.
class Walk {
public:
    Walk(const Balls& balls, float finest, std::size_t most)
        : balls_(balls), squared_finest_(finest * finest), most_(most) {}

    /// Consecutive triangles are often close together: the balls are selected for several at a time.
    void run(std::span<const SurfacePiece> triangles) {
        constexpr std::size_t at_a_time = 32;
        for (std::size_t begin = 0; begin < triangles.size() && !too_many(); begin += at_a_time) {
            const auto group = triangles.subspan(begin, std::min(at_a_time, triangles.size() - begin));
            select_for(group);
            for (const SurfacePiece& whole : group) {
                triangle_ = whole.triangle;
                select(whole.corners, 0, 0, selected_.size());
            }
        }
    }
    bool too_many() const { return open_.size() > most_; }
    std::vector<SurfacePiece> open() { return std::move(open_); }

private:
    struct Corner {
        PieceCorner at;
        Holders holders;
    };
    /// The balls that matter to a piece: a list of blocked_, and the same as indices in selected_.
    struct List {
        std::size_t begin, blocks, first, last;
        int level; ///< of the piece
    };
    using Corners = std::array<PieceCorner, 3>;
    static constexpr int deepest = 120;

    void select_for(std::span<const SurfacePiece> group) {
        selected_.resize(balls_.size());
        std::iota(selected_.begin(), selected_.end(), 0u);
        Box box;
        for (const SurfacePiece& piece : group) {
            for (const PieceCorner& p : piece.corners) {
                box.add(Vec3{p.x, p.y, p.z});
            }
        }
        const Vec3 middle = box.center();
        const PieceCorner place{static_cast<float>(middle.x), static_cast<float>(middle.y),
                                static_cast<float>(middle.z)};
        const std::size_t count = selected_.size();
        sift(place, static_cast<float>(box.diagonal() / 2), 0, count);
        selected_.erase(selected_.begin(), selected_.begin() + static_cast<std::ptrdiff_t>(count));
    }

    /// Divides a piece that no ball contains. Selects those of the balls from `begin` to `end` that matter to it.
    void select(const Corners& t, int level, std::size_t begin, std::size_t end) {
        if (too_many()) {
            return;
        }
        const auto& [a, b, c] = t;
        const float ab = squared_length(a, b), bc = squared_length(b, c), ca = squared_length(c, a);
        const float longest = std::max({ab, bc, ca});
        const PieceCorner middle{(a.x + b.x + c.x) / 3, (a.y + b.y + c.y) / 3, (a.z + b.z + c.z) / 3};
        constexpr float farthest = 2.0f / 3; // a corner from the middle, in lengths of the longest edge
        const std::size_t first = selected_.size(), last = sift(middle, farthest * std::sqrt(longest), begin, end);
        if (last - first <= lanes * most_blocks) {
            const List list{blocked_.size(), (last - first + lanes - 1) / lanes, first, last, level};
            fill(list);
            divide({at(a, list), at(b, list), at(c, list)}, level, list);
            blocked_.resize(list.begin);
        } else if (longest <= squared_finest_ || level >= deepest) {
            open_.push_back({triangle_, t});
        } else {
            const bool is_ab = ab == longest, is_bc = !is_ab && bc == longest;
            const PieceCorner half = is_ab ? middle_of(a, b) : is_bc ? middle_of(b, c) : middle_of(c, a);
            select(is_ab ? Corners{a, half, c} : Corners{a, b, half}, level + 1, first, last);
            select(is_bc ? Corners{a, half, c} : Corners{half, b, c}, level + 1, first, last);
        }
        selected_.resize(first);
    }

    /// Divides a piece if no ball contains it. Each division needs a look at one point only.
    void divide(const std::array<Corner, 3>& t, int level, const List& list) {
        const auto& [a, b, c] = t;
        if (too_many() || any_in_all(a.holders, b.holders, c.holders)) {
            return;
        }
        const float ab = squared_length(a.at, b.at), bc = squared_length(b.at, c.at), ca = squared_length(c.at, a.at);
        const float longest = std::max({ab, bc, ca});
        if (longest <= squared_finest_ || level >= deepest) {
            open_.push_back({triangle_, {a.at, b.at, c.at}});
            return;
        }
        constexpr int levels = 4; // fewer balls matter to a piece that is a quarter as long
        if (list.blocks > 1 && level >= list.level + levels) {
            select({a.at, b.at, c.at}, level, list.first, list.last);
            return;
        }
        const bool is_ab = ab == longest, is_bc = !is_ab && bc == longest;
        const Corner half = at(is_ab   ? middle_of(a.at, b.at)
                               : is_bc ? middle_of(b.at, c.at)
                                       : middle_of(c.at, a.at),
                               list);
        divide(is_ab ? std::array{a, half, c} : std::array{a, b, half}, level + 1, list);
        divide(is_bc ? std::array{a, half, c} : std::array{half, b, c}, level + 1, list);
    }

    Corner at(const PieceCorner& p, const List& list) const {
        Corner corner{p, {}};
        find_holders(blocked_, list.begin, list.blocks, p, corner.holders);
        return corner;
    }

    void fill(const List& list) {
        for (std::size_t k = list.first; k < list.last; ++k) {
            const Ball& ball = balls_[selected_[k]];
            blocked_.add(ball, ball.r * ball.r);
        }
        while (blocked_.size() < list.begin + list.blocks * lanes) {
            blocked_.add({}, -1);
        }
    }

    /// Appends those that may be nearest to some point within `size` of a place; returns the new end.
    std::size_t sift(const PieceCorner& place, float size, std::size_t begin, std::size_t end) {
        float least = std::numeric_limits<float>::infinity();
        gaps_.clear();
        for (std::size_t k = begin; k < end; ++k) {
            const Ball& ball = balls_[selected_[k]];
            gaps_.push_back(std::sqrt(ball.squared_distance(place.x, place.y, place.z)) - ball.r);
            least = std::min(least, gaps_.back());
        }
        for (std::size_t k = begin; k < end; ++k) {
            if (gaps_[k - begin] <= least + 2 * size) {
                selected_.push_back(selected_[k]);
            }
        }
        return selected_.size();
    }

    const Balls& balls_;
    float squared_finest_;
    std::size_t most_;
    std::vector<SurfacePiece> open_;
    std::uint32_t triangle_ = 0;
    std::vector<std::uint32_t> selected_; ///< a stack of lists
    std::vector<float> gaps_;
    BlockedBalls blocked_;
};

} // namespace

std::optional<std::vector<SurfacePiece>> open_pieces(std::span<const SurfacePiece> triangles, const Balls& balls,
                                                     float finest, std::size_t most) {
    Walk walk(balls, finest, most);
    walk.run(triangles);
    if (walk.too_many()) {
        return {};
    }
    return walk.open();
}

} // namespace foam::inline search::by_spheres
