#include <foam/geometry/length.hpp>

#include <foam/base/text.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace foam::inline geometry {
namespace {

/// A unit of length in metres, numerator / denominator: so that 7mm is the double nearest to 0.007.
struct Unit {
    std::string_view name;
    double numerator, denominator;
};
constexpr Unit units[] = {{"mm", 1, 1000}, {"cm", 1, 100}, {"m", 1, 1}, {"in", 0.0254, 1}};

const Unit* find_unit(std::string_view name) {
    const auto it = std::find_if(std::begin(units), std::end(units), [&](const Unit& u) { return u.name == name; });
    return it == std::end(units) ? nullptr : it;
}

/// Returns three significant digits, and all before the point: "0.125", "12.5", "1250", "1,250,000".
std::string three_digits(double value) {
    return std::abs(value) >= 1000 && std::abs(value) < 1e15
               ? count_text(static_cast<std::size_t>(std::llround(std::abs(value))))
               : fmt::format("{:.3g}", value);
}

/// Returns "mm" below a metre, else "m".
const Unit& unit_for(double metres) {
    return std::abs(metres) < 1 ? units[0] : units[2];
}

} // namespace

const std::vector<std::string>& length_units() {
    static const std::vector<std::string> names = [] {
        std::vector<std::string> list;
        for (const Unit& unit : units) {
            list.emplace_back(unit.name);
        }
        return list;
    }();
    return names;
}

std::optional<double> metres_in(std::string_view unit) {
    const Unit* known = find_unit(unit);
    return known ? std::optional(known->numerator / known->denominator) : std::nullopt;
}

std::optional<double> parse_length(std::string_view text) {
    const std::size_t letter = text.find_last_not_of("abcdefghijklmnopqrstuvwxyz");
    const std::size_t split = letter == text.npos ? 0 : letter + 1;
    std::string_view number = text.substr(0, split);
    const Unit* unit = split == text.size() ? &units[2] : find_unit(text.substr(split));
    if (split < text.size() && number.ends_with(' ')) {
        number.remove_suffix(1);
    }
    const std::optional<double> value = unit ? parse_number(number) : std::nullopt;
    const double metres = value ? *value * unit->numerator / unit->denominator : INFINITY;
    return std::isfinite(metres) ? std::optional(metres) : std::nullopt;
}

std::string length_forms() {
    return "a number in m, or one with mm, cm, m or in behind it, such as 10mm";
}

std::string length_text(double metres) {
    const Unit& unit = unit_for(metres);
    return fmt::format("{} {}", three_digits(metres * unit.denominator), unit.name);
}

std::string size_text(const Box& box) {
    const Vec3 size = box.size();
    const Unit& unit = unit_for(std::max({size.x, size.y, size.z}));
    return fmt::format("{} x {} x {} {}", three_digits(size.x * unit.denominator),
                       three_digits(size.y * unit.denominator), three_digits(size.z * unit.denominator), unit.name);
}

std::string count_text(std::size_t count) {
    const std::string digits = fmt::format("{}", count);
    std::string text;
    for (std::size_t i = 0; i < digits.size(); ++i) {
        if (i > 0 && (digits.size() - i) % 3 == 0) {
            text.push_back(',');
        }
        text.push_back(digits[i]);
    }
    return text;
}

} // namespace foam::geometry
