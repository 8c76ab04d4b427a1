// The parent's side: child processes until every question is answered or has ended one.
#include "engine.hpp"

#include <foam/base/error.hpp>
#include <foam/runtime/internal/bytes.hpp>
#include <foam/runtime/internal/child.hpp>
#include <foam/sdk/sdk.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <optional>

namespace foam::inline bench {
namespace {

/// What one child said.
struct Said {
    EngineReport& report;
    std::optional<std::uint64_t> begun; ///< the step that it has not answered
    bool done = false;

    /// True once there is nothing more to hear.
    bool hear(std::string_view message) {
        ByteReader in(message.substr(1));
        switch (static_cast<EngineWord>(message.front())) {
        case EngineWord::version:
            report.version = message.substr(1);
            return false;
        case EngineWord::error:
            report.error = message.substr(1);
            std::replace(report.error.begin(), report.error.end(), '\n', ' '); // it stands in tables
            return done = true;
        case EngineWord::begin:
            begun = in.take<std::uint64_t>();
            return false;
        case EngineWord::answer: {
            const auto step = in.take<std::uint64_t>();
            report.answers.at(step / 2)[model_of(step)] = in.take<EngineAnswer>();
            begun.reset();
            return false;
        }
        case EngineWord::done:
            return done = true;
        }
        return false;
    }
};

std::string ending(const ChildEnd& end, double seconds) {
    switch (end.why) {
    case ChildEnd::Why::signalled:
        return signal_text(end.number);
    case ChildEnd::Why::too_long:
        return fmt::format("no end within {:g} s", seconds);
    default:
        return fmt::format("exit code {}", end.number);
    }
}

std::string why_missing(const EngineName& engine) {
    return fmt::format("the program {} is not built; remedy: apt-get install {}, then configure and build foam again",
                       engine.program, engine.package);
}

} // namespace

std::span<const EngineName> engine_names() {
    static constexpr std::array<EngineName, 4> all{{{"fcl", "FCL", "foam-engine-fcl", "libfcl-dev"},
                                                    {"fcl_pairs", "FCL, pair by pair", "foam-engine-fcl", "libfcl-dev"},
                                                    {"bullet", "Bullet", "foam-engine-bullet", "libbullet-dev"},
                                                    {"mujoco", "MuJoCo", "foam-engine-mujoco", "libmujoco-dev"}}};
    return all;
}

const EngineName& find_engine(const std::string& name) {
    const auto engines = engine_names();
    const auto it =
        std::find_if(engines.begin(), engines.end(), [&](const EngineName& engine) { return name == engine.name; });
    if (it == engines.end()) {
        throw Error(ErrorCode::internal, fmt::format("there is no collision engine '{}'", name));
    }
    return *it;
}

std::filesystem::path engine_program(const EngineName& engine) {
    return library_folder() / "foam/engines" / engine.program;
}

EngineReport ask_engine(EngineProblem problem, const std::function<bool()>& cancelled, std::filesystem::path program) {
    EngineReport report;
    report.answers.resize(problem.queries.size());
    if (program.empty()) {
        const EngineName& engine = find_engine(problem.engine);
        program = engine_program(engine);
        if (!std::filesystem::exists(program)) {
            report.error = why_missing(engine);
            return report;
        }
    }
    const std::string name = program.filename().string();
    ChildLimits limits;
    limits.cancelled = cancelled;
    if (std::isfinite(problem.time_limit)) { // a query that never ends; on a busy machine CPU time takes its time
        constexpr double patience = 20, beginning = 300;
        limits.seconds = patience * problem.time_limit + beginning;
    }
    constexpr std::size_t most_aborts = 50;
    while (report.aborts.size() < most_aborts) {
        Said said{report, {}};
        const ChildEnd end =
            run_child(program, to_bytes(problem), limits, [&](std::string_view m) { return said.hear(m); });
        if (end.why == ChildEnd::Why::cancelled) {
            throw Error(ErrorCode::cancelled, "cancelled; nothing was written");
        }
        if (said.done) {
            return report;
        }
        const std::string why = ending(end, limits.seconds.value_or(0));
        if (!said.begun) {
            report.error = fmt::format("{} ended before the first query: {}", name, why);
            return report;
        }
        report.aborts.push_back(why);
        report.answers[*said.begun / 2][model_of(*said.begun)].state = EngineAnswer::State::aborted;
        problem.first = *said.begun + 1;
    }
    report.error =
        fmt::format("{} was given up after {} aborts, the last: {}", name, most_aborts, report.aborts.back());
    return report;
}

void append(EngineReport& report, EngineReport later) {
    report.version = std::move(later.version);
    report.error = std::move(later.error);
    report.answers.insert(report.answers.end(), later.answers.begin(), later.answers.end());
    report.aborts.insert(report.aborts.end(), later.aborts.begin(), later.aborts.end());
}

} // namespace foam::bench
