// Each kind of element that proofs erode, with random numbers of its own.
#pragma once

#include "geometry/some_elements.hpp"

#include <gtest/gtest.h>

#include <string>

namespace foam::test {

class EachBody : public ::testing::TestWithParam<Element::Kind> {
protected:
    Random random{derive_seed(21, to_string(GetParam()))};
};

inline const auto eroded_kinds =
    ::testing::Values(Element::Kind::sphere, Element::Kind::capsule, Element::Kind::cylinder, Element::Kind::box,
                      Element::Kind::swept_box, Element::Kind::hull);

inline std::string name_of_kind(const ::testing::TestParamInfo<Element::Kind>& kind) {
    return to_string(kind.param);
}

} // namespace foam::test
