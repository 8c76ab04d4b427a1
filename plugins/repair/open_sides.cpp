#include "open_sides.hpp"

#include "fans.hpp"

#include <algorithm>

namespace foam::repair {

std::vector<OpenSide> open_sides(const Mesh& mesh) {
    const std::vector<Side> sides = sorted_sides(mesh);
    std::vector<std::uint32_t> alone;
    for (std::size_t i = 0; i < sides.size(); ++i) {
        const bool partner =
            (i > 0 && sides[i - 1].same_edge(sides[i])) || (i + 1 < sides.size() && sides[i + 1].same_edge(sides[i]));
        if (!partner) {
            alone.push_back(sides[i].side);
        }
    }
    std::sort(alone.begin(), alone.end());
    std::vector<OpenSide> open;
    for (const std::uint32_t side : alone) {
        const Triangle& t = mesh.triangles[side / 3];
        open.push_back({t[side % 3], t[(side % 3 + 1) % 3], side / 3, side % 3});
    }
    return open;
}

} // namespace foam::repair
