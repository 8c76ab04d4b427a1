// What a call of the C interface is asked for: its settings, its time, its threads.
#pragma once

#include "reporting.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/search/cover.hpp>

#include <atomic>
#include <chrono>
#include <exception>
#include <functional>
#include <thread>

namespace foam::c {

/// The caller's request to end the search or the call: its time limit and its callback, which its thread alone calls.
class Poll final : public StopRequest {
public:
    /// `partial`: what is ended early has a result all the same; else its end is that of the call.
    Poll(const foam_options& options, bool partial) : options_(options), partial_(partial) {}

    bool used() const { return options_.poll || options_.time_limit > 0; }
    /// Returns whether the search should end, with or without a result.
    bool finish() {
        look();
        ended_search_ = ended_search_ || finish_;
        return finish_ || cancel_;
    }
    bool asked() const override {
        look();
        return cancel_;
    }
    bool ended_search() const { return ended_search_; }
    /// Throws what went wrong in the callback.
    void check() const;

private:
    using Clock = std::chrono::steady_clock;

    void look() const;
    void obey(int answer) const;

    const foam_options& options_;
    const bool partial_;
    const std::thread::id caller_ = std::this_thread::get_id();
    const Clock::time_point start_ = Clock::now();
    mutable Clock::time_point next_ = start_;
    bool ended_search_ = false;
    mutable bool finish_ = false;              ///< of the calling thread
    mutable std::atomic<bool> cancel_ = false; ///< which all threads read
    mutable std::exception_ptr error_;
};

/// The settings of a call, and what its caller asks for while it runs.
class Call {
public:
    enum class Kind {
        search, ///< ended early, it has a result all the same
        whole,  ///< it has a result at its end alone
    };
    /// Takes the settings; null: the defaults. Throws Error(usage) for one that is wrong.
    Call(const foam_options* given, Kind kind);

    /// Returns the settings of a search for elements of the kinds, which ends when the caller wants.
    CoverOptions search(std::vector<Element::Kind> kinds);
    /// Calls body() on the threads that the settings allow, until the caller wants its end. Throws what it throws,
    /// Error(cancelled) and what went wrong in the callback.
    void run(const std::function<void()>& body);
    /// Returns whether the caller ended a search, which has a result all the same.
    bool ended_search() const { return poll_.ended_search(); }

private:
    foam_options options_;
    Poll poll_;
};

} // namespace foam::c
