// Questions to a collision engine in a child process.
#pragma once

#include <foam/bench/collision_engine.hpp>

#include <filesystem>
#include <functional>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace foam::inline bench {

/// What engines are called, the programs they are in, and the packages that these need.
struct EngineName {
    const char* name;
    const char* label;   ///< for people
    const char* program; ///< in the folder foam/engines beside the core library
    const char* package; ///< of Debian
};
std::span<const EngineName> engine_names();
/// Throws Error(internal) for any other name.
const EngineName& find_engine(const std::string& name);

/// The robot's configuration as the poses of its bodies.
struct EngineQuery {
    std::uint32_t environment = 0;
    bool distance = false; ///< whether distances are asked for too
    std::vector<Pose> poses{};
    /// Above 0: the robot is only checked against itself, every pair, this number of times; times are of one check.
    std::uint32_t self_checks = 0;
};

/// Two models of a robot, body by body, and what is asked of both.
struct EngineProblem {
    std::string engine;
    std::array<EngineRobot, 2> models;
    std::vector<std::vector<Obstacle>> environments;
    std::vector<EngineQuery> queries;
    double time_limit = std::numeric_limits<double>::infinity(); ///< CPU s; what comes later is not asked

    std::uint64_t first = 0; ///< steps before it are left out; step 2 q + m: query q, the (m+1)-th model to be asked
};

/// What an engine says to a query about one model. Times in CPU s.
struct EngineAnswer {
    enum class State : std::uint8_t { not_asked, answered, aborted };
    State state = State::not_asked;
    bool hits_obstacle = false, hits_itself = false;
    double move_seconds = 0;                                    ///< to bring the model into the configuration
    double collision_seconds = 0;                               ///< obstacles, then itself unless it hits one
    double distance_seconds = 0;                                ///< to both
    double distance = std::numeric_limits<double>::quiet_NaN(); ///< m; NaN: not asked

    double seconds() const { return move_seconds + collision_seconds + distance_seconds; }
    bool collides() const { return hits_obstacle || hits_itself; }
};

struct EngineReport {
    std::string version;
    std::string error;                                ///< why there are no answers; empty if there are
    std::vector<std::array<EngineAnswer, 2>> answers; ///< of each query, by model
    std::vector<std::string> aborts;                  ///< how the process ended, once for each that did not end well
};

/// The model that a step is about: even queries ask the first one first, odd ones the second.
constexpr std::size_t model_of(std::uint64_t step) {
    return static_cast<std::size_t>((step + step / 2) % 2);
}

/// Where the program of an engine is, built or not.
std::filesystem::path engine_program(const EngineName& engine);

/// Asks everything, in child processes: one that aborts is reported, and the next one goes on behind the step that it
/// aborted at. `program`: empty: that of the engine. Throws Error(internal) if no process can be started,
/// Error(cancelled).
EngineReport ask_engine(EngineProblem problem, const std::function<bool()>& cancelled = {},
                        std::filesystem::path program = {});

/// The answers of a later portion of the queries behind those of the earlier ones.
void append(EngineReport& report, EngineReport later);

/// Bytes between the two processes.
std::string to_bytes(const EngineProblem& problem);
/// Throws Error(internal) for other bytes.
EngineProblem problem_from_bytes(std::string_view bytes);

/// What the child says; the first byte of a message.
enum class EngineWord : char { version = 'v', error = 'e', begin = 'b', answer = 'a', done = 'd' };

} // namespace foam::bench
