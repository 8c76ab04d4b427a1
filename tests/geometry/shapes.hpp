// Meshes for the tests of geometry: exact shapes, tessellated shapes and broken ones.
#pragma once

#include "plain_shapes.hpp"

#include <foam/robot/robot.hpp>
#include <foam/runtime/contract.hpp>

namespace foam::test {

inline Mesh torus(double large, double small, std::uint32_t n = 32) {
    return sample::torus(large, small, n, n);
}

} // namespace foam::test
