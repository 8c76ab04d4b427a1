// Lengths without a unit, which are in metres, and often meant in millimetres.
#pragma once

#include <string>
#include <string_view>

namespace foam {
inline namespace [[gnu::visibility("default")]] recipe {

/// A length that is written as a number without a unit.
struct PlainLength {
    std::string name; ///< "pad", "--pad", "max_gap of simplify.mine"
    double metres = 0;
};

/// Returns a question about a length that is larger than `of` ("the whole input"), whose size is `size` in m: the
/// length, the size, and how to write it in millimetres. Empty: it is not larger, or the size is not above 0.
std::string question_about(const PlainLength& length, double size, std::string_view of);

} // namespace recipe
} // namespace foam
