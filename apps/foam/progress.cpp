#include "execute.hpp"

#include "cli/program.hpp"

#include <foam/base/text.hpp>

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <sys/ioctl.h>
#include <unistd.h>

namespace foam::cli {
namespace {

std::size_t terminal_width() {
    winsize size{};
    return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

std::string time_left(const Event& event) {
    if (!event.seconds_left) {
        return "";
    }
    const double left = *event.seconds_left;
    return left < 90 ? fmt::format("{:.0f} s left", left) : fmt::format("{:.0f} min left", left / 60);
}

const char* word_for(Severity severity) {
    switch (severity) {
    case Severity::warning:
        return "warning";
    case Severity::error:
        return "error";
    case Severity::debug:
    case Severity::info:
        break;
    }
    return "note";
}

/// As much of a line as takes no more columns.
std::string cut_to(std::string line, std::size_t columns) {
    while (shown_width(line) > columns) {
        do { // a whole character
            const bool continues = (static_cast<unsigned char>(line.back()) & 0xC0U) == 0x80U;
            line.pop_back();
            if (!continues) {
                break;
            }
        } while (!line.empty());
    }
    return line;
}

/// "link, stage: "; what is of the whole run has no place.
std::string place_of(const Event& event) {
    if (event.link.empty() && event.stage.empty()) {
        return "";
    }
    const char* separator = event.link.empty() || event.stage.empty() ? "" : ", ";
    return fmt::format("{}{}{}: ", shown(event.link), separator, shown(event.stage));
}

} // namespace

Progress::Progress(bool verbose, bool quiet) : verbose_(verbose), quiet_(quiet) {
    const char* terminal = std::getenv("TERM");
    terminal_ = isatty(STDERR_FILENO) == 1 && terminal && std::string_view(terminal) != "dumb";
}

Progress::~Progress() {
    clear();
}

void Progress::on(const Event& event) {
    if (event.kind == Event::Kind::finding) {
        if (event.severity >= Severity::warning || verbose_) {
            clear();
            tell(fmt::format("{}: {}{}", word_for(event.severity), place_of(event), event.message));
        }
    } else if (quiet_) {
        return;
    } else if (event.kind == Event::Kind::input_loaded) {
        clear();
        tell(event.message);
    } else if (terminal_) {
        draw(event);
    }
}

void Progress::draw(const Event& event) {
    if (event.kind == Event::Kind::run_finished) {
        clear();
        return;
    }
    if (!event.stage.empty()) {
        task_ = shown(event.link.empty() ? event.stage : event.link + " " + event.stage);
    }
    constexpr double least_seconds = 0.1; // between two drawings
    if (event.seconds - last_drawn_ < least_seconds) {
        return;
    }
    last_drawn_ = event.seconds;
    constexpr int cells = 20;
    const int full = static_cast<int>(event.done * cells);
    std::string line = fmt::format("[{:#<{}}{:.<{}}] {:3.0f} % {} {}", "", full, "", cells - full,
                                   std::floor(event.done * 100), task_, time_left(event));
    fmt::print(stderr, "\r\033[K{}", cut_to(line, terminal_width() - 1));
    std::fflush(stderr);
    drawn_ = true;
}

void Progress::clear() {
    if (drawn_) {
        fmt::print(stderr, "\r\033[K");
        drawn_ = false;
    }
}

} // namespace foam::cli
