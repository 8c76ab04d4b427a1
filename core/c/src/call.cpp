#include "call.hpp"

#include <foam/base/internal/activity.hpp>

#include <fmt/format.h>

#include <cstddef>
#include <cstring>
#include <optional>
#include <utility>

namespace foam::c {

/// Returns the settings of a caller who was compiled with this or an earlier version of the struct: members that came
/// later are 0, which is their default.
static foam_options options_of(const foam_options* given) {
    constexpr std::size_t first_version = offsetof(foam_options, max_vertices);
    foam_options options{};
    if (given) {
        if (given->size != first_version) {
            require_size(given->size, sizeof(foam_options), "options");
        }
        std::memcpy(&options, given, given->size);
    }
    options.size = sizeof(foam_options);
    return options;
}

static void check(const foam_options& options) {
    if (options.effort < FOAM_NORMAL || options.effort > FOAM_BEST) {
        throw usage(fmt::format("options->effort is {}; remedy: FOAM_NORMAL, FOAM_FAST or FOAM_BEST", options.effort));
    }
    if (options.objective < FOAM_EXCESS || options.objective > FOAM_MEAN_PROTRUSION) {
        throw usage(fmt::format("options->objective is {}; remedy: FOAM_EXCESS, FOAM_PROTRUSION, FOAM_RADIUS or "
                                "FOAM_MEAN_PROTRUSION",
                                options.objective));
    }
    if (!(options.time_limit >= 0)) {
        throw usage(
            fmt::format("options->time_limit is {}; remedy: seconds above 0, or 0 for no limit", options.time_limit));
    }
    constexpr std::uint32_t most_threads = 4096;
    if (options.threads > most_threads) {
        throw usage(fmt::format("options->threads is {}; remedy: at most {}, or 0 for one per core", options.threads,
                                most_threads));
    }
    if (options.reserved != 0) {
        throw usage(fmt::format("options->reserved is {}; remedy: initialise the struct, all of it", options.reserved));
    }
    if (options.max_vertices != 0 && options.max_vertices < 4) {
        throw usage(fmt::format("options->max_vertices is {}; remedy: at least 4, or 0 for 64", options.max_vertices));
    }
    if (options.axis_aligned != 0 && options.axis_aligned != 1) {
        throw usage(fmt::format("options->axis_aligned is {}; remedy: 0 or 1", options.axis_aligned));
    }
}

static Effort effort_of(const foam_options& options) {
    return options.effort == FOAM_FAST   ? Effort::fast
           : options.effort == FOAM_BEST ? Effort::best
                                         : Effort::normal;
}

static Objective objective_of(const foam_options& options) {
    return options.objective == FOAM_PROTRUSION        ? Objective::protrusion
           : options.objective == FOAM_RADIUS          ? Objective::radius
           : options.objective == FOAM_MEAN_PROTRUSION ? Objective::mean_protrusion
                                                       : Objective::excess;
}

void Poll::check() const {
    if (error_) {
        std::rethrow_exception(error_);
    }
}

void Poll::look() const {
    if (std::this_thread::get_id() != caller_ || cancel_) {
        return;
    }
    const auto now = Clock::now();
    if (options_.time_limit > 0 && std::chrono::duration<double>(now - start_).count() >= options_.time_limit) {
        finish_ = true;
        cancel_ = cancel_ || !partial_;
    }
    if (!options_.poll || now < next_) {
        return;
    }
    try { // not from here: any loop may be above
        obey(options_.poll(options_.user));
    } catch (...) {
        error_ = std::current_exception();
        cancel_ = true;
    }
    next_ = Clock::now() + std::chrono::milliseconds(2);
}

void Poll::obey(int answer) const {
    if (answer == FOAM_FINISH) {
        finish_ = true;
        cancel_ = !partial_;
    } else if (answer == FOAM_CANCEL) {
        cancel_ = true;
    } else if (answer != FOAM_CONTINUE) {
        throw usage(
            fmt::format("options->poll returned {}; remedy: FOAM_CONTINUE, FOAM_FINISH or FOAM_CANCEL", answer));
    }
}

Call::Call(const foam_options* given, Kind kind)
    : options_(options_of(given)), poll_(options_, kind == Kind::search) {
    check(options_);
}

CoverOptions Call::search(std::vector<Element::Kind> kinds) {
    CoverOptions settings{.kinds = std::move(kinds),
                          .effort = effort_of(options_),
                          .objective = objective_of(options_),
                          .seed = options_.seed,
                          .axis_aligned = options_.axis_aligned == 1};
    if (options_.max_vertices != 0) {
        settings.max_vertices = options_.max_vertices;
    }
    if (poll_.used()) {
        settings.stop = [this] { return poll_.finish(); };
    }
    return settings;
}

void Call::run(const std::function<void()>& body) {
    try {
        on_threads(options_.threads, [&] {
            std::optional<StopScope> scope;
            if (poll_.used()) {
                scope.emplace(&poll_);
            }
            body();
        });
    } catch (...) {
        poll_.check();
        throw;
    }
    poll_.check();
}

} // namespace foam::c
