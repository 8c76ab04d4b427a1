#include "numbers.hpp"

#include <foam/base/text.hpp>

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <functional>

namespace foam::cli {
namespace {

/// Returns a validator that the help does not show.
CLI::Validator expecting(std::string what, std::function<bool(double)> holds) {
    const auto check = [what = std::move(what), holds = std::move(holds)](std::string& word) {
        const std::optional<double> number = parse_number(word);
        return number && std::isfinite(*number) && holds(*number) ? std::string()
                                                                  : fmt::format("expects {}, got '{}'", what, word);
    };
    return {check, ""};
}

} // namespace

CLI::Validator whole_number(std::uint64_t least, std::uint64_t most) {
    const std::string range = most < std::numeric_limits<std::uint64_t>::max()
                                  ? fmt::format(" from {} to {}", least, most)
                                  : fmt::format(" of at least {}", least);
    const auto check = [=](std::string& word) {
        std::uint64_t number = 0;
        const char* const end = word.data() + word.size();
        const auto [read, error] = std::from_chars(word.data(), end, number);
        return error == std::errc() && read == end && number >= least && number <= most
                   ? std::string()
                   : fmt::format("expects a whole number{}, got '{}'", range, word);
    };
    return {check, ""};
}

CLI::Validator number_above(double least) {
    return expecting(fmt::format("a finite number above {:g}", least), [=](double number) { return number > least; });
}

CLI::Validator number_from(double least) {
    return expecting(fmt::format("a finite number of at least {:g}", least),
                     [=](double number) { return number >= least; });
}

CLI::Validator number_between(double below, double above) {
    return expecting(fmt::format("a number between {:g} and {:g}", below, above),
                     [=](double number) { return number > below && number < above; });
}

} // namespace foam::cli
