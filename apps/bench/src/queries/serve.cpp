// The child's side: a problem from standard input, answers to the descriptor of the parent.
#include "engine.hpp"

#include <foam/base/error.hpp>
#include <foam/runtime/internal/bytes.hpp>
#include <foam/runtime/internal/child.hpp>

#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <ctime>
#include <exception>

namespace foam::inline bench {

CollisionEngine::CollisionEngine() = default;
CollisionEngine::~CollisionEngine() = default;

namespace {

/// CPU s of this thread; what others do on the machine does not count.
double thread_seconds() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

std::string standard_input() {
    std::string all;
    char chunk[65536];
    for (std::size_t n; (n = std::fread(chunk, 1, sizeof chunk, stdin)) > 0;) {
        all.append(chunk, n);
    }
    return all;
}

/// One message. Without a parent there is nobody to answer to.
void send(EngineWord word, std::string_view content = {}) {
    std::string bytes;
    put(bytes, static_cast<std::uint64_t>(content.size() + 1));
    put(bytes, word);
    bytes.append(content);
    for (std::size_t done = 0; done < bytes.size();) {
        const ssize_t n = write(answer_descriptor, bytes.data() + done, bytes.size() - done);
        if (n < 0 && errno != EINTR) {
            _exit(1);
        }
        done += n > 0 ? static_cast<std::size_t>(n) : 0;
    }
}

template <class Work> double timed(Work&& work) {
    const double begin = thread_seconds();
    work();
    return thread_seconds() - begin;
}

/// Asks for self-collision alone, often enough for the clock.
EngineAnswer self_checked(CollisionEngine& engine, const EngineQuery& query) {
    EngineAnswer answer;
    answer.state = EngineAnswer::State::answered;
    const auto times = static_cast<double>(query.self_checks);
    answer.move_seconds = timed([&] {
                              for (std::uint32_t i = 0; i < query.self_checks; ++i) {
                                  engine.move(query.poses);
                              }
                          }) /
                          times;
    answer.collision_seconds = timed([&] {
                                   for (std::uint32_t i = 0; i < query.self_checks; ++i) {
                                       answer.hits_itself = engine.hits_itself(true);
                                   }
                               }) /
                               times;
    return answer;
}

EngineAnswer asked(CollisionEngine& engine, const EngineQuery& query) {
    if (query.self_checks > 0) {
        return self_checked(engine, query);
    }
    EngineAnswer answer;
    answer.state = EngineAnswer::State::answered;
    answer.move_seconds = timed([&] { engine.move(query.poses); });
    answer.collision_seconds = timed([&] {
        answer.hits_obstacle = engine.hits_obstacle();
        answer.hits_itself = !answer.hits_obstacle && engine.hits_itself(false);
    });
    if (answer.hits_obstacle) {
        answer.hits_itself = engine.hits_itself(false);
    }
    if (query.distance) {
        answer.distance_seconds = timed([&] {
            answer.distance = engine.distance_to_obstacles();
            answer.distance = std::min(answer.distance, engine.distance_to_itself());
        });
    }
    return answer;
}

void serve(const EngineProblem& problem, const EngineMaker& make) {
    std::array<std::unique_ptr<CollisionEngine>, 2> engines;
    if (!problem.environments.empty()) {
        for (std::size_t m = 0; m < engines.size(); ++m) {
            engines[m] = make(problem.engine, problem.models[m], problem.environments.front());
        }
    }
    std::array<std::uint32_t, 2> environment{UINT32_MAX, UINT32_MAX};
    const double end = thread_seconds() + problem.time_limit;
    for (std::uint64_t step = problem.first; step < 2 * problem.queries.size() && thread_seconds() < end; ++step) {
        const EngineQuery& query = problem.queries[step / 2];
        const std::size_t m = model_of(step);
        std::string place;
        put(place, step);
        send(EngineWord::begin, place);
        if (environment[m] != query.environment) {
            environment[m] = query.environment;
            engines[m]->set_obstacles(problem.environments[query.environment]);
        }
        const EngineAnswer answer = asked(*engines[m], query);
        put(place, answer);
        send(EngineWord::answer, place);
    }
}

} // namespace

int serve_engine(const std::string& version, const EngineMaker& make) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    const rlimit no_core{0, 0}; // an abort is counted; a library that aborts often would fill the disk
    setrlimit(RLIMIT_CORE, &no_core);
    try {
        const EngineProblem problem = problem_from_bytes(standard_input());
        send(EngineWord::version, version);
        serve(problem, make);
        send(EngineWord::done);
        return 0;
    } catch (const std::exception& error) {
        send(EngineWord::error, error.what());
        return 1;
    }
}

} // namespace foam::bench
