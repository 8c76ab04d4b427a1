#include "messages.hpp"

#include <foam/base/text.hpp>

#include <fmt/color.h>
#include <fmt/format.h>

#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <utility>

namespace foam::cli {
namespace {

/// Set once, before the command runs.
struct Showing {
    bool colour_out = false, colour_err = false;
    std::vector<std::string> standard_input;
};

Showing& showing() {
    static Showing one;
    return one;
}

bool takes_colour(int descriptor) {
    const char* refused = std::getenv("NO_COLOR");
    const char* terminal = std::getenv("TERM");
    return isatty(descriptor) == 1 && !(refused && *refused) && terminal && std::string_view(terminal) != "dumb";
}

struct Highlight {
    std::string_view begin; ///< of a line, or after ": "
    fmt::terminal_color colour;
};

constexpr std::array highlights{
    Highlight{"error:", fmt::terminal_color::red},      Highlight{"error[", fmt::terminal_color::red},
    Highlight{"Not proved", fmt::terminal_color::red},  Highlight{"Not certified", fmt::terminal_color::red},
    Highlight{"warning:", fmt::terminal_color::yellow}, Highlight{"warning[", fmt::terminal_color::yellow},
    Highlight{"stopped:", fmt::terminal_color::yellow}, Highlight{"Proved", fmt::terminal_color::green},
    Highlight{"Certified", fmt::terminal_color::green},
};

/// Returns the line with its first highlighted word in colour. A word counts at the begin of the line or after ": ".
std::string coloured_line(std::string_view line) {
    std::size_t first = line.npos;
    const Highlight* found = nullptr;
    for (const Highlight& word : highlights) {
        std::size_t at = line.find(word.begin);
        while (at != line.npos && at != 0 && !line.substr(0, at).ends_with(": ")) {
            at = line.find(word.begin, at + 1);
        }
        if (at < first) {
            first = at;
            found = &word;
        }
    }
    if (!found) {
        return std::string(line);
    }
    const std::size_t length = found->begin.size() - (found->begin.ends_with('[') ? 1 : 0);
    return std::string(line.substr(0, first)) +
           fmt::format(fmt::emphasis::bold | fmt::fg(found->colour), "{}", line.substr(first, length)) +
           std::string(line.substr(first + length));
}

std::string coloured_lines(std::string_view text) {
    std::string result;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        result += coloured_line(text.substr(0, end));
        result += text.substr(end, 1);
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return result;
}

} // namespace

void choose_colours(Colour colour) {
    showing().colour_out = colour == Colour::always || (colour == Colour::automatic && takes_colour(STDOUT_FILENO));
    showing().colour_err = colour == Colour::always || (colour == Colour::automatic && takes_colour(STDERR_FILENO));
}

void show_as_standard_input(std::vector<std::string> names) {
    showing().standard_input = std::move(names);
}

std::string with_names(std::string text) {
    constexpr std::string_view shown = "stdin", of_longer_names = "_-0123456789";
    for (const std::string& name : showing().standard_input) {
        for (std::size_t at = 0; (at = text.find(name, at)) != text.npos; at += shown.size()) {
            if (const char next = text[at + name.size()]; of_longer_names.find(next) == of_longer_names.npos) {
                text.replace(at, name.size(), shown);
            }
        }
    }
    return text;
}

std::string coloured(const std::string& text, Stream stream) {
    const bool wanted = stream == Stream::out ? showing().colour_out : showing().colour_err;
    return wanted ? coloured_lines(text) : text;
}

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

std::string did_you_mean(const std::string& word, const std::vector<std::string>& known) {
    const std::string near = nearest_word(word, known);
    return near.empty() ? "" : fmt::format("; did you mean '{}'?", near);
}

std::string unknown_command(const std::string& word, const std::vector<std::string>& known) {
    return fmt::format("unknown command '{}'{}", word, did_you_mean(word, known));
}

} // namespace foam::cli
