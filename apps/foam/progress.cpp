#include "progress.hpp"

#include "program.hpp"

#include <fmt/format.h>

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
    if (event.done < 0.05 || event.seconds < 0.5) {
        return "";
    }
    const double left = event.seconds / event.done * (1 - event.done);
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

/// "link, stage: "; what is of the whole run has no place.
std::string place_of(const Event& event) {
    if (event.link.empty() && event.stage.empty()) {
        return "";
    }
    const char* separator = event.link.empty() || event.stage.empty() ? "" : ", ";
    return fmt::format("{}{}{}: ", event.link, separator, event.stage);
}

} // namespace

Progress::Progress(bool verbose) : verbose_(verbose) {
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
        task_ = event.link.empty() ? event.stage : event.link + " " + event.stage;
    }
    constexpr double least_seconds = 0.1; // between two drawings
    if (event.seconds - last_drawn_ < least_seconds) {
        return;
    }
    last_drawn_ = event.seconds;
    constexpr int cells = 20;
    const int full = static_cast<int>(event.done * cells);
    std::string line = fmt::format("[{:#<{}}{:.<{}}] {:3.0f} % {} {}", "", full, "", cells - full, event.done * 100,
                                   task_, time_left(event));
    line.resize(std::min(line.size(), terminal_width() - 1));
    fmt::print(stderr, "\r\033[K{}", line);
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
