// Numbers as text and back: what is written reads back to the same number.
#include <foam/base/text.hpp>

#include <charconv>
#include <cmath>

namespace foam::inline base {

std::string number_text(double value) {
    char buffer[64];
    const auto [end, error] = std::to_chars(buffer, buffer + sizeof buffer, value);
    return {buffer, end};
}

std::optional<double> parse_number(std::string_view text) {
    // std::from_chars does not accept a plus sign, which other programs write.
    if (text.starts_with('+') && !text.starts_with("+-")) {
        text.remove_prefix(1);
    }
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) {
        return {};
    }
    return value;
}

} // namespace foam::base
