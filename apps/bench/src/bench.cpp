#include "bench.hpp"

#include <foam/base/error.hpp>

#include <algorithm>
#include <cmath>
#include <ctime>

namespace foam::inline bench::experiment {

double cpu_seconds() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

void Bench::check_cancelled() const {
    if (cancelled()) {
        throw Error(ErrorCode::cancelled, "cancelled; nothing was written");
    }
}

void Bench::tell(const std::string& line) const {
    if (options_.tell) {
        options_.tell(line);
    }
}

LimitedContext::LimitedContext(const Bench& bench, double limit) : bench_(bench), end_(cpu_seconds() + limit) {}

bool LimitedContext::cancelled() const {
    if (bench_.cancelled() || over_limit()) {
        return true;
    }
    constexpr auto pause = std::chrono::duration_cast<Clock::duration>(std::chrono::milliseconds(50));
    const Clock::rep now = Clock::now().time_since_epoch().count();
    if (now >= next_look_.load(std::memory_order_relaxed)) {
        next_look_.store(now + pause.count(), std::memory_order_relaxed);
        if (cpu_seconds() > end_) {
            over_limit_.store(true, std::memory_order_relaxed);
        }
    }
    return over_limit();
}

std::string short_number(double value) {
    if (!std::isfinite(value)) {
        return "–";
    }
    constexpr int significant = 3, most = 6;
    const int magnitude = value == 0 ? 0 : static_cast<int>(std::floor(std::log10(std::abs(value))));
    const int digits = std::clamp(significant - 1 - magnitude, 0, most);
    return fmt::format("{:.{}f}", value, digits);
}

} // namespace foam::bench::experiment
