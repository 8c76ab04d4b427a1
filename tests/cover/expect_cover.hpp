// What every cover promises.
#pragma once

#include <foam/geometry/measure.hpp>
#include <foam/search/spherize.hpp>

#include <gtest/gtest.h>

namespace foam::test {

inline void expect_cover(const Solid& solid, const SphereCover& cover, std::size_t most) {
    EXPECT_GE(cover.spheres.size(), 1u);
    EXPECT_LE(cover.spheres.size(), most);
    EXPECT_TRUE(cover.certificate.holds);
    EXPECT_TRUE(certify(solid, cover.spheres).holds);
}

} // namespace foam::test
