#include <foam/text.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace foam {

std::string number_text(double value) {
    char buffer[64];
    const auto [end, error] = std::to_chars(buffer, buffer + sizeof buffer, value);
    return {buffer, end};
}

std::optional<double> parse_number(std::string_view text) {
    // std::from_chars knows no plus sign, which other programs write.
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

std::vector<std::string_view> words(std::string_view text) {
    constexpr std::string_view blank = " \t\r\n";
    std::vector<std::string_view> result;
    for (std::size_t begin = 0; (begin = text.find_first_not_of(blank, begin)) != std::string_view::npos;) {
        const std::size_t end = std::min(text.find_first_of(blank, begin), text.size());
        result.push_back(text.substr(begin, end - begin));
        begin = end;
    }
    return result;
}

} // namespace foam
