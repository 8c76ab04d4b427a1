#include "pieces.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/base/parallel.hpp>

#include <algorithm>
#include <queue>

namespace foam::inline search::convex {
namespace {

bool touch(const Box& a, const Box& b) {
    constexpr double near = 1e-6; // units
    return a.low.x <= b.high.x + near && b.low.x <= a.high.x + near && a.low.y <= b.high.y + near &&
           b.low.y <= a.high.y + near && a.low.z <= b.high.z + near && b.low.z <= a.high.z + near;
}

struct Offer {
    double price; ///< what the common element adds
    std::uint32_t a, b;

    bool operator>(const Offer& o) const { return std::tie(price, a, b) > std::tie(o.price, o.a, o.b); }
};

class Merging {
public:
    Merging(const std::vector<Brick>& bricks, Price price) : price_(std::move(price)) {
        pieces_.resize(bricks.size());
        parallel_for(bricks.size(), [&](std::size_t i) {
            pieces_[i] = piece_of(bricks, {static_cast<std::uint32_t>(i)});
            pieces_[i].price = price_(pieces_[i].hull);
        });
        dead_.assign(pieces_.size(), 0);
        std::vector<Offer> pairs;
        for (std::uint32_t a = 0; a < pieces_.size(); ++a) {
            for (std::uint32_t b = a + 1; b < pieces_.size(); ++b) {
                if (touch(pieces_[a].box, pieces_[b].box)) {
                    pairs.push_back({0, a, b});
                }
            }
        }
        offer(std::move(pairs));
    }

    /// Returns the pieces: one a brick, and then one for each merge. `dead_after`: the number of merges after which a
    /// piece is part of another.
    std::vector<Piece> run(std::vector<std::size_t>& dead_after) {
        const std::size_t bricks = pieces_.size();
        dead_after.assign(bricks, SIZE_MAX);
        for (std::size_t alive = bricks; alive > 1;) {
            check_cancelled();
            if (offers_.empty()) {
                offer_all();
            }
            const Offer best = offers_.top();
            offers_.pop();
            if (!dead_[best.a] && !dead_[best.b]) {
                merge(best.a, best.b);
                dead_after.push_back(SIZE_MAX);
                dead_after[best.a] = dead_after[best.b] = bricks - --alive;
            }
        }
        return std::move(pieces_);
    }

private:
    double price(std::uint32_t a, std::uint32_t b) const {
        std::vector<Vec3> points = pieces_[a].hull;
        points.insert(points.end(), pieces_[b].hull.begin(), pieces_[b].hull.end());
        return price_(points) - pieces_[a].price - pieces_[b].price;
    }
    void offer(std::vector<Offer> pairs) {
        const auto one = [&](std::size_t i) {
            check_cancelled();
            pairs[i].price = price(pairs[i].a, pairs[i].b);
        };
        constexpr std::size_t many = 32;
        if (pairs.size() >= many) {
            parallel_for(pairs.size(), one);
        } else {
            for (std::size_t i = 0; i < pairs.size(); ++i) {
                one(i);
            }
        }
        for (const Offer& pair : pairs) {
            offers_.push(pair);
        }
    }
    void offer_all() {
        std::vector<Offer> pairs;
        for (std::uint32_t a = 0; a < pieces_.size(); ++a) {
            for (std::uint32_t b = a + 1; b < pieces_.size(); ++b) {
                if (!dead_[a] && !dead_[b]) {
                    pairs.push_back({0, a, b});
                }
            }
        }
        offer(std::move(pairs));
    }
    void merge(std::uint32_t a, std::uint32_t b) {
        Piece both;
        both.bricks.resize(pieces_[a].bricks.size() + pieces_[b].bricks.size());
        std::merge(pieces_[a].bricks.begin(), pieces_[a].bricks.end(), pieces_[b].bricks.begin(),
                   pieces_[b].bricks.end(), both.bricks.begin());
        std::vector<Vec3> points = pieces_[a].hull;
        points.insert(points.end(), pieces_[b].hull.begin(), pieces_[b].hull.end());
        HullOfPoints hull;
        hull.run(points);
        for (const std::uint32_t v : hull.vertices()) {
            both.hull.push_back(points[v]);
        }
        both.price = price_(both.hull);
        both.box = pieces_[a].box;
        both.box.add(pieces_[b].box);
        dead_[a] = dead_[b] = 1;
        const auto made = static_cast<std::uint32_t>(pieces_.size());
        std::vector<Offer> pairs;
        for (std::uint32_t i = 0; i < made; ++i) {
            if (!dead_[i] && touch(pieces_[i].box, both.box)) {
                pairs.push_back({0, i, made});
            }
        }
        pieces_.push_back(std::move(both));
        dead_.push_back(0);
        offer(std::move(pairs));
    }

    Price price_;
    std::vector<Piece> pieces_;
    std::vector<char> dead_;
    std::priority_queue<Offer, std::vector<Offer>, std::greater<>> offers_;
};

} // namespace

double Partition::price() const {
    double sum = 0;
    for (const Piece& piece : pieces) {
        sum += piece.price;
    }
    return sum;
}

Piece piece_of(const std::vector<Brick>& bricks, std::vector<std::uint32_t> members) {
    Piece piece;
    std::vector<Vec3> points;
    for (const std::uint32_t i : members) {
        points.insert(points.end(), bricks[i].points.begin(), bricks[i].points.end());
        piece.box.add(bricks[i].box);
    }
    HullOfPoints hull;
    hull.run(points);
    for (const std::uint32_t v : hull.vertices()) {
        piece.hull.push_back(points[v]);
    }
    piece.bricks = std::move(members);
    return piece;
}

Piece piece_of(const std::vector<Brick>& bricks, std::vector<std::uint32_t> members, const Pricing& pricing) {
    Piece piece = piece_of(bricks, std::move(members));
    pricing.appraise(piece);
    return piece;
}

Merges::Merges(const std::vector<Brick>& bricks, Price price) : bricks_(bricks.size()) {
    pieces_ = Merging(bricks, std::move(price)).run(dead_after_);
}

std::vector<Piece> Merges::at(std::size_t count) const {
    const std::size_t merges = bricks_ - std::min(count, bricks_);
    std::vector<Piece> result;
    for (std::size_t i = 0; i < bricks_ + merges; ++i) {
        if (dead_after_[i] > merges) {
            result.push_back(pieces_[i]);
        }
    }
    return result;
}

std::vector<Brick> united(const std::vector<Brick>& bricks, const std::vector<Piece>& pieces) {
    std::vector<Brick> result;
    HullOfPoints hull;
    for (const Piece& piece : pieces) {
        Polygons surface;
        for (const std::uint32_t i : piece.bricks) {
            surface.append(bricks[i].surface);
        }
        result.push_back(brick_around(hull, piece.hull, std::move(surface)));
        for (const std::uint32_t i : piece.bricks) {
            result.back().regions.insert(result.back().regions.end(), bricks[i].regions.begin(), bricks[i].regions.end());
        }
    }
    return result;
}

} // namespace foam::inline search::convex
