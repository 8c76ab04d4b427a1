// A part of a solid: winding numbers near what closes it.
#include "geometry/fine_shapes.hpp"
#include "geometry/src/mesh/mesh_part.hpp"

#include <gtest/gtest.h>

using namespace foam;
using namespace foam::geometry;
using namespace foam::test;

TEST(MeshPart, WindingNumbersOfALargeOpenOneByExpansionToo) {
    const Mesh bowl = fine_bowl();
    const MeshPart part(bowl, read_as_solid(bowl));
    // On the flat closing surface lines do not tell the side, and the expansion of the bowl itself is used. Seen from
    // there, the hole is half the sky.
    for (const double aside : {0.05, 0.17, 0.3}) {
        EXPECT_NEAR(part.winding({aside, 0.01, part.bounds().high.z}), 0.5, 0.01);
    }
    EXPECT_NEAR(part.winding({0, 0, -3}), 0, 0.01);
}
