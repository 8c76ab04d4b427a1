#include "placement.hpp"

#include <algorithm>
#include <cmath>

namespace foam::scene {

std::array<double, 4> message_quaternion(const Pose& pose) {
    const auto& [a, b, c] = pose.rotation;
    // The largest of the four components is computed by a root, the others from it: no digits cancel (Shepperd 1978).
    const std::array<double, 4> squares{1 + a.x - b.y - c.z, 1 - a.x + b.y - c.z, 1 - a.x - b.y + c.z,
                                        1 + a.x + b.y + c.z};
    const auto largest = static_cast<std::size_t>(std::max_element(squares.begin(), squares.end()) - squares.begin());
    const std::array<std::array<double, 4>, 4> products{{{squares[0], a.y + b.x, c.x + a.z, c.y - b.z},
                                                         {a.y + b.x, squares[1], b.z + c.y, a.z - c.x},
                                                         {c.x + a.z, b.z + c.y, squares[2], b.x - a.y},
                                                         {c.y - b.z, a.z - c.x, b.x - a.y, squares[3]}}};
    std::array<double, 4> q = products[largest];
    double length = 0;
    for (const double x : q) {
        length += x * x;
    }
    length = std::sqrt(length) * (q[3] < 0 ? -1 : 1);
    for (double& x : q) {
        x = x / length + 0.0; // never -0
    }
    return q;
}

} // namespace foam::scene
