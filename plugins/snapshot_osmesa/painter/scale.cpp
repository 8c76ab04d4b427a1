#include "scale.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace foam::snapshot {
namespace {

struct Unit {
    const char* name;
    double metres;
};

/// Returns the unit in which `value` is at least one; metres from 1 m on, nanometres for the smallest.
Unit suitable_unit(double value) {
    constexpr std::array<Unit, 4> units{{{"m", 1}, {"mm", 1e-3}, {"µm", 1e-6}, {"nm", 1e-9}}};
    for (const Unit& unit : units) {
        if (value >= 0.9995 * unit.metres) {
            return unit;
        }
    }
    return units.back();
}

/// Returns 1, 2 or 5 times a power of ten, near `step`.
double nice_step(double step) {
    const double power = std::pow(10.0, std::floor(std::log10(step)));
    const double lead = step / power;
    return (lead < 1.5 ? 1 : lead < 3.5 ? 2 : lead < 7.5 ? 5 : 10) * power;
}

/// Returns a number with fixed `decimals`, or with as many digits as distinguish ticks if it is too large or small for
/// that.
std::string number_text(double value, int decimals) {
    std::array<char, 64> buffer{};
    const bool plain = decimals <= 6 && std::abs(value) < 1e9;
    const auto end =
        plain ? std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::fixed,
                              std::max(0, decimals))
              : std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::general, 9);
    return {buffer.data(), end.ptr};
}

} // namespace

Scale make_scale(double least, double most) {
    const Unit unit = suitable_unit(most);
    Scale scale{unit.name, {}};
    const double low = least / unit.metres, high = most / unit.metres;
    if (high - low <= 1e-6 * high) {
        const int digits = 3 - static_cast<int>(std::floor(std::log10(high)));
        scale.ticks.push_back({most, number_text(high, digits)});
        return scale;
    }
    const double step = nice_step((high - low) / 5);
    const int decimals = std::max(0, -static_cast<int>(std::floor(std::log10(step) + 1e-9)));
    const double first = std::ceil(low / step - 1e-9);
    for (int i = 0; (first + i) * step <= high + 1e-9 * step; ++i) {
        const double value = (first + i) * step;
        scale.ticks.push_back({value * unit.metres, number_text(value, decimals)});
    }
    return scale;
}

} // namespace foam::snapshot
