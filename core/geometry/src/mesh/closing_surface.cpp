#include "mesh/orientation.hpp"

#include <foam/base/cancellation.hpp>

#include <array>
#include <map>
#include <span>

namespace foam::inline geometry {
namespace {

/// Limits below which two corners of the rim are joined: shares of the extent, and of the mean length of its edges.
constexpr double crack_of_extent = 1.0 / 100, crack_of_edge = 1.0 / 2;

class Closing {
public:
    Closing(const Mesh& mesh, const Reading& reading) : mesh_(mesh), rim_(reading.rim) {}

    Mesh run() {
        draw_together();
        for (const RimEdge& edge : rim_) {
            const std::uint32_t from = drawn_.at(edge.from), to = drawn_.at(edge.to);
            for (std::ptrdiff_t k = 0; k < edge.times; ++k) {
                add(edge.to, edge.from, from);
                add(edge.to, from, to);
            }
            if (from != to) {
                left_[{std::min(from, to), std::max(from, to)}] += from < to ? edge.times : -edge.times;
            }
        }
        fill_curves();
        return std::move(result_);
    }

private:
    using Cell = std::array<std::int64_t, 3>;

    /// Moves every corner of the rim to the first one that is near enough.
    void draw_together() {
        Box box;
        double length = 0;
        for (const RimEdge& edge : rim_) {
            drawn_[edge.from] = edge.from; // the rim consists of closed curves: every corner begins an edge
            box.add(mesh_.vertices[edge.from]);
            length += distance(mesh_.vertices[edge.from], mesh_.vertices[edge.to]);
        }
        const double mean = length / static_cast<double>(std::max<std::size_t>(rim_.size(), 1));
        const double limit = std::min(crack_of_extent * box.diagonal(), crack_of_edge * mean);
        std::map<Cell, std::vector<std::uint32_t>> kept;
        CancellationCounter asking(1024);
        for (auto& [corner, target] : drawn_) {
            asking.check();
            const Vec3 p = mesh_.vertices[corner];
            const auto cell = [&](double x, double low) {
                return limit > 0 ? static_cast<std::int64_t>(std::floor((x - low) / limit)) : 0;
            };
            const Cell home{cell(p.x, box.low.x), cell(p.y, box.low.y), cell(p.z, box.low.z)};
            for (int k = 0; k < 27 && target == corner; ++k) {
                const auto near = kept.find({home[0] + k % 3 - 1, home[1] + k / 3 % 3 - 1, home[2] + k / 9 - 1});
                if (near == kept.end()) {
                    continue;
                }
                for (const std::uint32_t other : near->second) {
                    if (distance(p, mesh_.vertices[other]) < limit) {
                        target = other;
                        break;
                    }
                }
            }
            if (target == corner) {
                kept[home].push_back(corner);
            }
        }
    }

    /// Closes the remaining edges, which enter every corner as often as they leave it. A path along them that returns
    /// to a corner has gone around a closed curve, which is cut off.
    void fill_curves() {
        std::map<std::uint32_t, std::vector<std::uint32_t>> next;
        for (const auto& [ends, times] : left_) {
            for (std::ptrdiff_t k = 0; k < std::abs(times); ++k) {
                next[times > 0 ? ends.first : ends.second].push_back(times > 0 ? ends.second : ends.first);
            }
        }
        std::map<std::uint32_t, std::size_t> place;
        std::vector<std::uint32_t> way;
        for (auto& [start, unused] : next) {
            while (!unused.empty()) {
                std::uint32_t at = start;
                do {
                    place[at] = way.size();
                    way.push_back(at);
                    std::vector<std::uint32_t>& out = next.at(at);
                    at = out.back();
                    out.pop_back();
                    if (const auto before = place.find(at); before != place.end()) {
                        const std::size_t begin = before->second;
                        fill({way.begin() + static_cast<std::ptrdiff_t>(begin), way.end()});
                        while (way.size() > begin) {
                            place.erase(way.back());
                            way.pop_back();
                        }
                    }
                } while (!way.empty() || at != start);
            }
        }
    }

    /// Adds a fan over a closed curve of at least three corners.
    void fill(std::span<const std::uint32_t> curve) {
        if (curve.size() == 3) {
            add(curve[0], curve[2], curve[1]);
            return;
        }
        Vec3 sum{};
        double length = 0;
        for (std::size_t k = 0; k < curve.size(); ++k) {
            const Vec3 &a = mesh_.vertices[curve[k]], &b = mesh_.vertices[curve[(k + 1) % curve.size()]];
            sum += (a + b) * (distance(a, b) / 2);
            length += distance(a, b);
        }
        const Vec3 middle = sum / length;
        for (std::size_t k = 0; k < curve.size(); ++k) {
            add(middle, mesh_.vertices[curve[(k + 1) % curve.size()]], mesh_.vertices[curve[k]]);
        }
    }

    void add(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        if (a != b && b != c && c != a) {
            add(mesh_.vertices[a], mesh_.vertices[b], mesh_.vertices[c]);
        }
    }
    void add(const Vec3& a, const Vec3& b, const Vec3& c) {
        const auto first = static_cast<std::uint32_t>(result_.vertices.size());
        result_.vertices.insert(result_.vertices.end(), {a, b, c});
        result_.triangles.push_back({first, first + 1, first + 2});
    }

    const Mesh& mesh_;
    const std::vector<RimEdge>& rim_;
    std::map<std::uint32_t, std::uint32_t> drawn_; // a corner of the rim, and its target
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::ptrdiff_t> left_;
    Mesh result_;
};

} // namespace

Mesh closing_surface(const Mesh& mesh, const Reading& reading) {
    return Closing(mesh, reading).run();
}

} // namespace foam::geometry
