// The smallest double with a property, for adversaries of proofs.
#pragma once

#include <bit>
#include <cstdint>

namespace foam::test {

/// Returns the smallest double, to the last bit, for which `passes` is true: a bisection over the doubles themselves.
/// Precondition: 0 < low < high; `passes` is false at `low` and true at `high`.
template <class Passes> double smallest(double low, double high, Passes&& passes) {
    auto a = std::bit_cast<std::uint64_t>(low), b = std::bit_cast<std::uint64_t>(high);
    while (b - a > 1) {
        const std::uint64_t middle = a + (b - a) / 2;
        (passes(std::bit_cast<double>(middle)) ? b : a) = middle;
    }
    return std::bit_cast<double>(b);
}

} // namespace foam::test
