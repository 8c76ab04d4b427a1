#include "octree.hpp"

#include <foam/base/parallel.hpp>

namespace foam::repair {
namespace {

/// A point of the grid of half cells of the finest level, which has the corners and middles of all leaves.
using Place = Cell;
/// The eight corners of a leaf, then its middle.
using Probes = std::array<Place, 9>;

Probes probes_of(const Octree& octree, const Node& node) {
    const Cell low = octree.low_cell(node);
    const std::int32_t half = octree.cells_across(node); // half the leaf, in half cells
    Probes probes{};
    for (int corner = 0; corner < 8; ++corner) {
        for (int axis = 0; axis < 3; ++axis) {
            const auto a = static_cast<std::size_t>(axis);
            probes[static_cast<std::size_t>(corner)][a] = 2 * (low[a] + (corner >> axis & 1) * half);
        }
    }
    probes[8] = {2 * low[0] + half, 2 * low[1] + half, 2 * low[2] + half};
    return probes;
}

/// The places inside of a solid. Each is computed once, although neighbouring leaves share places.
class Insides {
public:
    Insides(std::vector<Place> places, const Octree& octree, const Solid& solid) : places_(std::move(places)) {
        std::sort(places_.begin(), places_.end());
        places_.erase(std::unique(places_.begin(), places_.end()), places_.end());
        inside_.resize(places_.size());
        parallel_for(places_.size(), [&](std::size_t i) {
            const Place& p = places_[i];
            inside_[i] = solid.contains(Vec3{double(p[0]), double(p[1]), double(p[2])} * (octree.cell_size() / 2));
        });
    }
    bool at(const Place& place) const {
        return inside_[static_cast<std::size_t>(std::lower_bound(places_.begin(), places_.end(), place) -
                                                places_.begin())];
    }

private:
    std::vector<Place> places_;
    std::vector<char> inside_;
};

} // namespace

void fill_openings(Octree& octree, const Solid& solid, Context& context) {
    std::vector<std::uint32_t> open;
    for (std::uint32_t i = 0; i < octree.nodes().size(); ++i) {
        if (octree.nodes()[i].state == State::enclosed) {
            open.push_back(i);
        }
    }
    const auto is_finest = [&](std::uint32_t i) { return octree.nodes()[i].level == octree.depth(); };
    while (!open.empty()) {
        context.check_cancelled();
        std::vector<Place> places;
        for (const std::uint32_t i : open) {
            const Probes probes = probes_of(octree, octree.nodes()[i]);
            // A leaf that cannot be split is judged by its middle only.
            places.insert(places.end(), is_finest(i) ? probes.end() - 1 : probes.begin(), probes.end());
        }
        const Insides insides(std::move(places), octree, solid);
        std::vector<std::uint32_t> next;
        for (const std::uint32_t i : open) {
            const Probes probes = probes_of(octree, octree.nodes()[i]);
            const bool middle = insides.at(probes[8]);
            const bool mixed = !is_finest(i) && std::any_of(probes.begin(), probes.end(),
                                                            [&](const Place& p) { return insides.at(p) != middle; });
            if (mixed) {
                const std::uint32_t first = octree.split(i);
                for (std::uint32_t child = 0; child < 8; ++child) {
                    next.push_back(first + child);
                }
            } else if (middle) {
                octree.nodes()[i].state = State::filled;
            }
        }
        open = std::move(next);
    }
}

} // namespace foam::repair
