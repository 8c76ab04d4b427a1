#include <foam/base/internal/activity.hpp>
#include <foam/runtime/internal/limits.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace foam::inline runtime {
namespace {

constexpr double time_to_stop = 1.5; // s
constexpr double late = 1.1, and_late = 0.3;
constexpr double time_to_write = 2; // s; later still, where a result that is there waits to be proved and written
constexpr double least_share_to_finish = 0.15;

bool is_set(const std::atomic<bool>* flag) {
    return flag && flag->load(std::memory_order_relaxed);
}

void raise_to(std::atomic<double>& value, double least) {
    for (double known = value.load(); known < least && !value.compare_exchange_weak(known, least);) {
    }
}

} // namespace

Limits::Limits(const RunOptions& options, std::optional<double> time_limit, const Journal& journal)
    : options_(options), outer_(options.stop || options.cancel ? nullptr : current_work().request),
      time_limit_(time_limit), journal_(journal) {
    for (std::size_t i = 0; i < requests_.size(); ++i) {
        requests_[i].bind(*this, static_cast<Phase>(i));
    }
}

bool Limits::is_cancelled() const {
    return is_set(options_.cancel) || (outer_ && outer_->asked());
}

std::optional<double> Limits::stopped() const {
    if (!is_set(options_.stop) && !is_cancelled()) {
        return {};
    }
    double seen = stopped_.load();
    if (seen < 0) {
        const double now = journal_.seconds();
        if (stopped_.compare_exchange_strong(seen, now)) {
            return now;
        }
    }
    return seen;
}

/// Returns when work ends because of the time limit. Precondition: there is one.
double Limits::end_of_limit() const {
    return late * *time_limit_ + and_late - kept_.load();
}

std::optional<double> Limits::hard_end(Phase phase) const {
    std::optional<double> end;
    if (time_limit_) {
        end = end_of_limit() + (phase == Phase::finishing && only_writing_is_left_ ? time_to_write : 0);
    }
    if (const auto stop = stopped()) {
        end = std::min(end.value_or(*stop + time_to_stop), *stop + time_to_stop);
    }
    return end;
}

bool Limits::is_over(Phase phase) const {
    const auto end = hard_end(phase);
    return end && journal_.seconds() >= *end;
}

/// Returns the time to reserve for finishing: 1.5 times the measured time, because results have more spheres than the
/// first trees.
double Limits::reserve() const {
    return std::max(1.5 * std::max(all_.load(), longest_.load()),
                    time_limit_ ? least_share_to_finish * *time_limit_ : 0.0);
}

/// Returns whether it is too late for first spheres. Without a time limit the time for finishing has not been measured.
bool Limits::too_late_to_begin() const {
    const double now = journal_.seconds();
    if (const auto stop = stopped(); stop && now >= *stop + time_to_stop / 2) {
        return true;
    }
    return time_limit_ && now >= end_of_limit() - std::max(reserve(), least_share_to_finish * and_late);
}

/// Returns whether it is too late to grow and measure. Only a time limit replaces the result by a simpler one.
bool Limits::too_late_to_cover() const {
    const double end = time_limit_ ? end_of_limit() : 0;
    return time_limit_ && journal_.seconds() >= end - std::max(0.4 * reserve(), least_share_to_finish * end);
}

/// Returns whether it is too late for anything but writing the result.
bool Limits::too_late_to_complete() const {
    const double now = journal_.seconds();
    if (const auto stop = stopped(); stop && now >= *stop + time_to_stop / 2) {
        return true;
    }
    const double end = time_limit_ ? end_of_limit() : 0;
    return time_limit_ && now >= end - std::max(writing_.load(), least_share_to_finish * end);
}

void Limits::release_kept() {
    kept_.store(0);
    only_writing_is_left_ = true;
}

void Limits::keep_for_enclosing(std::size_t triangles) {
    // A million triangles take 0.1 to 0.2 s of one core to enclose and to prove, and less to prove again. Where other
    // programs take the cores, reading has taken as much longer as this will.
    constexpr double a_triangle = 2e-7, again = 5e-8, share = 0.1, of_reading = 0.7;
    if (time_limit_) {
        const double work = std::max(a_triangle * static_cast<double>(triangles), of_reading * journal_.seconds());
        kept_.store(share * end_of_limit() + work);
        writing_.store(again * static_cast<double>(triangles));
    }
}

bool Limits::has_time_for(double seconds) const {
    return !time_limit_ || journal_.seconds() + seconds < end_of_limit();
}

bool Limits::may_enclose() const {
    return time_limit_ && !stopped() && journal_.seconds() < late * *time_limit_ + and_late;
}

Cut Limits::cut(Phase phase) const {
    if (phase == Phase::finishing || phase == Phase::covering || phase == Phase::completing) {
        return Cut::none;
    }
    if (is_set(options_.stop)) {
        return Cut::stop;
    }
    if (!time_limit_ || phase == Phase::preparing) {
        return Cut::none;
    }
    const bool over = phase == Phase::searching ? journal_.seconds() >= *time_limit_ - reserve()
                      : phase == Phase::beginning ? too_late_to_begin()
                                                  : journal_.seconds() >= *time_limit_;
    return over ? Cut::time_limit : Cut::none;
}

bool Limits::ended(Phase phase) const {
    if (is_cancelled() || is_over(phase)) {
        return true;
    }
    return phase == Phase::beginning    ? too_late_to_begin()
           : phase == Phase::covering   ? too_late_to_cover()
           : phase == Phase::completing ? too_late_to_complete()
                                        : cut(phase) != Cut::none;
}

bool Limits::overdue(Phase phase) const {
    return is_cancelled() || (phase == Phase::searching ? too_late_to_begin() : ended(phase)) ||
           is_over(phase);
}

bool Limits::owns(const StopRequest* request) const {
    return std::any_of(requests_.begin(), requests_.end(), [&](const Request& own) { return &own == request; });
}

void Limits::add_to_reserve(double seconds, std::size_t times, std::size_t threads) {
    all_.fetch_add(seconds * static_cast<double>(times) / static_cast<double>(std::max<std::size_t>(1, threads)));
    raise_to(longest_, seconds);
}

void Limits::interrupted_at(const std::string& place) {
    if (is_over(Phase::finishing)) {
        const std::lock_guard lock(mutex_);
        if (place_.empty()) {
            place_ = place;
        }
    }
}

Error Limits::explained() const {
    if (!time_limit_ || stopped()) {
        return {ErrorCode::cancelled, "cancelled; nothing was written"};
    }
    const std::lock_guard lock(mutex_);
    return {ErrorCode::geometry,
            fmt::format("the time limit of {} s ended{}; nothing was written; remedy: a longer limit or a simpler mesh",
                        *time_limit_, place_.empty() ? "" : " while working on " + place_)};
}

std::optional<Limits::Due> Limits::due() const {
    constexpr double slow_to_stop = 1.9, slow_after_limit = 0.5; // s
    std::optional<Due> due;
    if (time_limit_) {
        due = Due{Cut::time_limit,
                  late * *time_limit_ + slow_after_limit + (only_writing_is_left_ ? time_to_write : 0)};
    }
    if (const auto stop = stopped(); stop && (!due || *stop + slow_to_stop < due->seconds)) {
        due = Due{Cut::stop, *stop + slow_to_stop};
    }
    return due;
}

} // namespace foam::runtime
