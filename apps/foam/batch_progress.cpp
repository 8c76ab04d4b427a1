#include "batch_progress.hpp"

#include <fmt/format.h>

#include <unistd.h>

namespace foam::cli {

std::string span_text(double seconds) {
    return seconds < 100       ? fmt::format("{:.0f} s", seconds)
           : seconds < 6000    ? fmt::format("{:.0f} min", seconds / 60)
           : seconds < 172'800 ? fmt::format("{:.1f} h", seconds / 3600)
                               : fmt::format("{:.1f} days", seconds / 86'400);
}

BatchProgressBar::BatchProgressBar() : terminal_(isatty(STDERR_FILENO) != 0) {}

void BatchProgressBar::show(const BatchProgress& progress) {
    if (!terminal_ || progress.meshes == 0) {
        return;
    }
    constexpr std::size_t width = 20;
    const std::size_t filled = width * progress.done / progress.meshes;
    const double left = static_cast<double>(progress.meshes - progress.done);
    fmt::print(stderr, "\r\033[K[{:#<{}}{:.<{}}] {}/{} meshes, {} failed, {:.1f}/s{}", "", filled, "", width - filled,
               progress.done, progress.meshes, progress.failed, progress.rate,
               progress.rate > 0 ? fmt::format(", {} left", span_text(left / progress.rate)) : "");
    drawn_ = true;
}

void BatchProgressBar::clear() {
    if (drawn_) {
        fmt::print(stderr, "\r\033[K");
        drawn_ = false;
    }
}

} // namespace foam::cli
