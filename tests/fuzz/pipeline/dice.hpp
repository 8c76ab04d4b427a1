// Random choices, the same for the same seed.
#pragma once

#include <foam/base/random.hpp>

#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <string>
#include <vector>

namespace foam::fuzz {

class Dice {
public:
    explicit Dice(std::uint64_t seed) : random_(seed) {}

    bool chance(double share) { return random_.uniform() < share; }
    std::size_t below(std::size_t count) { return static_cast<std::size_t>(random_.below(count)); }
    /// Both ends included.
    int between(int low, int high) { return low + static_cast<int>(below(static_cast<std::size_t>(high - low) + 1)); }
    double uniform(double low, double high) { return random_.uniform(low, high); }
    /// Even on a logarithmic scale; both above 0.
    double magnitude(double low, double high) { return std::exp(uniform(std::log(low), std::log(high))); }
    double sign() { return chance(0.5) ? 1 : -1; }
    template <class T> const T& of(const std::vector<T>& items) { return items[below(items.size())]; }
    template <class T> T of(std::initializer_list<T> items) { return items.begin()[below(items.size())]; }

    /// 10 to a power between -330 and 308, zero and subnormal numbers included.
    double odd_magnitude() {
        if (chance(0.1)) {
            return of(
                {0.0, 5e-324, 2.2250738585072014e-308, 1.7976931348623157e308, 1e-160, 1e155, 1e-12, 1e9, 1e16, 3.0});
        }
        return chance(0.5) ? std::pow(10.0, uniform(-330, 308)) : std::pow(10.0, uniform(-20, 20));
    }

private:
    Random random_;
};

/// The shortest text that reads back to the same double.
std::string text_of(double value);
/// As JSON and YAML take it.
std::string quoted(const std::string& text);

} // namespace foam::fuzz
