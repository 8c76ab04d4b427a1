#include "process/process.hpp"

#include <foam/base/internal/activity.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

namespace foam::inline runtime {
namespace {

/// Returns what the threads of a run are working on, each place once.
std::vector<std::string> places_of(const Limits& limits) {
    std::vector<std::string> places;
    for (std::size_t i = 0; const Activity* activity = active(i); ++i) {
        const ActivityText text = text_of(*activity);
        if (text.front() != '\0' && limits.owns(request_of(*activity))) {
            places.emplace_back(text.data());
        }
    }
    std::sort(places.begin(), places.end());
    places.erase(std::unique(places.begin(), places.end()), places.end());
    return places;
}

} // namespace

Watchdog::Watchdog(const Limits& limits, const RunOptions& options, Journal& journal)
    : limits_(limits), options_(options), journal_(journal) {
    if (options.stop || options.cancel || limits.time_limit()) {
        thread_ = std::thread([this] { watch(); });
    }
}

Watchdog::~Watchdog() {
    {
        const std::lock_guard lock(mutex_);
        done_ = true;
    }
    wake_.notify_all();
    if (thread_.joinable()) {
        thread_.join();
    }
}

void Watchdog::watch() {
    constexpr auto tick = std::chrono::milliseconds(20);
    std::unique_lock lock(mutex_);
    while (!wake_.wait_for(lock, tick, [this] { return done_; })) {
        const auto due = limits_.due();
        if (due && journal_.seconds() >= due->seconds) {
            lock.unlock();
            bark(*due);
            return;
        }
    }
}

void Watchdog::bark(const Limits::Due& due) {
    const Unresponsive what{due.asked, journal_.seconds(), places_of(limits_)};
    if (options_.on_unresponsive) {
        options_.on_unresponsive(what);
        return;
    }
    for (const std::string& place : what.at) {
        journal_.finding({Severity::warning, "", "", place + ": it continues after the request to stop"});
    }
}

} // namespace foam::runtime
