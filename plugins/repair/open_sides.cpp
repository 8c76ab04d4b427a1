#include "open_sides.hpp"

#include <algorithm>
#include <tuple>

namespace foam::repair {

std::vector<OpenSide> open_sides(const Mesh& mesh) {
    std::vector<OpenSide> sides;
    sides.reserve(3 * mesh.triangles.size());
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
        for (std::uint32_t k = 0; k < 3; ++k) {
            sides.push_back({mesh.triangles[i][k], mesh.triangles[i][(k + 1) % 3], i, k});
        }
    }
    const auto edge = [](const OpenSide& s) { return std::pair(std::min(s.from, s.to), std::max(s.from, s.to)); };
    std::stable_sort(sides.begin(), sides.end(),
                     [&](const OpenSide& a, const OpenSide& b) { return edge(a) < edge(b); });
    std::vector<OpenSide> open;
    for (std::size_t i = 0; i < sides.size(); ++i) {
        const bool alone = (i == 0 || edge(sides[i - 1]) != edge(sides[i])) &&
                           (i + 1 == sides.size() || edge(sides[i + 1]) != edge(sides[i]));
        if (alone) {
            open.push_back(sides[i]);
        }
    }
    std::sort(open.begin(), open.end(), [](const OpenSide& a, const OpenSide& b) {
        return std::tie(a.triangle, a.place) < std::tie(b.triangle, b.place);
    });
    return open;
}

} // namespace foam::repair
