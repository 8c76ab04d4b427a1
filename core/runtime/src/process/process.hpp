// Stages in processes of their own: calls, signals, limits that are watched.
#pragma once

#include <foam/base/error.hpp>
#include <foam/geometry/internal/own_frame.hpp>
#include <foam/geometry/solid.hpp>
#include <foam/runtime/internal/limits.hpp>
#include <foam/runtime/internal/workspace.hpp>
#include <foam/sdk/context.hpp>
#include <foam/sdk/parameter.hpp>
#include <foam/sdk/stage.hpp>

#include <array>
#include <condition_variable>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

namespace foam::inline runtime {

/// A call of a stage. The member `what` determines the meaning of `work`.
struct StageRequest {
    enum class What : std::uint8_t { probe, load, filter, spherize };

    What what = What::probe;
    std::int64_t parent = 0;        ///< process id of the parent
    std::uint64_t threads = 1;      ///< at most
    std::uint64_t memory_limit = 0; ///< MiB; 0: no limit
    std::string plugin;             ///< path of the plugin
    std::vector<std::string> used;  ///< paths of the plugins whose stages this stage uses
    std::string stage;              ///< empty for a probe, which only loads the plugin
    std::map<std::string, ParameterValue> given;
    std::uint64_t seed = 0;
    std::string work; ///< load: the file's path; filter: put_mesh(); spherize: put_shape_work()
};

/// Returns whether serve_isolated_call() was called, so that a child of this program can answer.
bool serves_isolated_calls();

std::string to_bytes(const StageRequest& request);
/// Parses a request. Throws Error(internal) if the bytes are not one.
StageRequest request_from(std::string_view bytes);

void put_shape_work(std::string& out, const Shape& shape, std::span<const Budget> budgets);
/// A call of a spherizer. The child builds the shape again from its parts: equal input gives an equal shape.
struct ShapeCall {
    Shape shape;
    std::vector<Budget> budgets;
};
ShapeCall shape_call_from(std::string_view bytes);

/// The first byte of a message from the child.
enum class Answer : char { progress = 'p', log = 'l', metric = 'm', result = 'r', error = 'e' };

/// The kinds of thrown objects that described() distinguishes.
enum class Thrown : std::uint8_t { error, bad_alloc, exception, other };

/// Returns the message for `thrown`. The other function below throws it again in the parent.
std::string error_answer(std::exception_ptr thrown);
[[noreturn]] void rethrow_answer(std::string_view rest);

// Calls of stages: in this process, or in a child process where the recipe requests it. The results are the same, byte
// for byte.

/// These functions throw what the stage throws. For an isolated stage they also throw Error for a crash, a limit or an
/// early end of its process.
Mesh call_loader(const Calls& calls, const StageCall& call, const std::filesystem::path& file, Context& context);
/// Calls a filter with the mesh in a normalised frame.
Mesh call_filter(const Workspace& workspace, const StageCall& call, const Mesh& mesh, Context& context);
/// A stage and its search for one shape.
struct StartedSearch {
    std::unique_ptr<Spherizer> stage;
    std::unique_ptr<SphereSearch> search;
};

/// Calls a spherizer. `started`: filled by the first call, unless the stage is isolated; further calls continue it.
/// `shape`: in `frame`, from which the trees are transformed back. The call and the budgets are in metres.
std::vector<SphereTree> call_spherizer(const Workspace& workspace, const StageCall& call, StartedSearch& started,
                                       const Shape& shape, const geometry::OwnFrame& frame,
                                       std::span<const Budget> budgets, Context& context);

/// Adds a stage's isolation to a hash, for tasks that are shared only if they run alike. Not part of a cache key.
void add_isolation(Hasher& hasher, const Isolation& isolation);

struct CrashSignal {
    int number;
    const char* text;
};

/// Signals that a program raises by its own faults.
inline constexpr std::array<CrashSignal, 5> crash_signals{
    {{SIGSEGV, "SIGSEGV, invalid memory access or stack overflow"},
     {SIGBUS, "SIGBUS, invalid memory access"},
     {SIGFPE, "SIGFPE, invalid arithmetic"},
     {SIGILL, "SIGILL, invalid instruction"},
     {SIGABRT, "SIGABRT, the program aborted"}}};

/// Registers a folder that remove_unfinished_runs() removes. Returns its slot; -1: there is none left.
int keep_for_crash(const std::filesystem::path& folder);
/// Takes the folder back.
void forget_for_crash(int slot);

/// Watches a run during its lifetime. Starts no thread if nothing can request the end of the run.
class Watchdog {
public:
    Watchdog(const Limits& limits, const RunOptions& options, Journal& journal);
    ~Watchdog();
    Watchdog(const Watchdog&) = delete;
    Watchdog& operator=(const Watchdog&) = delete;

private:
    void watch();
    void bark(const Limits::Due& due);

    const Limits& limits_;
    const RunOptions& options_;
    Journal& journal_;
    std::mutex mutex_;
    std::condition_variable wake_;
    bool done_ = false;
    std::thread thread_;
};

} // namespace foam::inline runtime
