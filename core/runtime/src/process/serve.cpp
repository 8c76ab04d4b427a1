// The child's side of an isolated call.
#include "process/process.hpp"

#include <foam/base/parallel.hpp>
#include <foam/runtime/internal/bytes.hpp>
#include <foam/runtime/internal/child.hpp>
#include <foam/runtime/process.hpp>
#include <foam/sdk/registry.hpp>

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <mutex>

namespace foam::inline runtime {
namespace {

/// A property of the process, set by its main().
bool serves = false;

/// Ends the process: without a parent nobody reads the answer.
[[noreturn]] void give_up() {
    _exit(1);
}

/// Sends the reports of a stage to the parent, one message each.
class RemoteContext final : public Context {
public:
    explicit RemoteContext(std::uint64_t seed) : seed_(seed) {}
    std::uint64_t seed() const override { return seed_; }
    bool cancelled() const override { return false; } // the parent ends this process instead
    void progress(double fraction) override {
        constexpr double step = 0.001; // finer steps are not visible
        {
            const std::lock_guard lock(mutex_);
            if (std::abs(fraction - shown_) < step) {
                return;
            }
            shown_ = fraction;
        }
        std::string message = begin(Answer::progress);
        put(message, fraction);
        send(message);
    }
    void log(Severity severity, std::string_view text) override {
        std::string message = begin(Answer::log);
        put(message, severity);
        put_text(message, text);
        send(message);
    }
    void metric(std::string_view name, double value, std::string_view unit) override {
        std::string message = begin(Answer::metric);
        put_text(message, name);
        put(message, value);
        put_text(message, unit);
        send(message);
    }

    static std::string begin(Answer answer) { return std::string(1, static_cast<char>(answer)); }
    void send(std::string_view message) {
        std::string head;
        put(head, static_cast<std::uint64_t>(message.size()));
        const std::lock_guard lock(mutex_);
        write_all(head);
        write_all(message);
    }

private:
    static void write_all(std::string_view bytes) {
        while (!bytes.empty()) {
            const ssize_t n = write(answer_descriptor, bytes.data(), bytes.size());
            if (n < 0 && errno != EINTR) {
                give_up();
            }
            bytes.remove_prefix(n > 0 ? static_cast<std::size_t>(n) : 0);
        }
    }

    std::uint64_t seed_;
    std::mutex mutex_;
    double shown_ = -1;
};

std::string answer_to(const StageRequest& request, Context& context) {
    std::string answer = RemoteContext::begin(Answer::result);
    Registry registry;
    const PluginRecord& plugin = registry.load(request.plugin);
    if (request.what == StageRequest::What::probe) {
        return answer; // the stage did not crash, whatever its result
    }
    if (!plugin.loaded()) {
        throw Error(ErrorCode::plugin, "plugin " + request.plugin + " is refused: " + plugin.rejection);
    }
    for (const std::string& used : request.used) {
        registry.load(used);
    }
    switch (request.what) {
    case StageRequest::What::load:
        put_mesh(answer, registry.make<MeshLoader>(request.stage, request.given)->load(request.work, context));
        break;
    case StageRequest::What::filter: {
        ByteReader in(request.work);
        const Mesh mesh = take_mesh(in);
        put_mesh(answer, registry.make<MeshFilter>(request.stage, request.given)->apply(mesh, context));
        break;
    }
    case StageRequest::What::spherize: {
        const ShapeCall call = shape_call_from(request.work);
        const auto stage = registry.make<Spherizer>(request.stage, request.given);
        const std::vector<SphereTree> trees = stage->search(call.shape)->at_most(call.budgets, context);
        put(answer, static_cast<std::uint64_t>(trees.size()));
        for (const SphereTree& tree : trees) {
            put_tree(answer, tree);
        }
        break;
    }
    case StageRequest::What::probe:
        break;
    }
    return answer;
}

[[noreturn]] void serve() {
    std::string bytes;
    StageRequest request;
    try {
        std::ifstream input("/dev/stdin", std::ios::binary);
        bytes.assign(std::istreambuf_iterator<char>(input), {});
        request = request_from(bytes);
    } catch (const std::exception&) {
        static constexpr std::string_view why = "foam: this command is for foam itself\n";
        [[maybe_unused]] const auto written = write(STDERR_FILENO, why.data(), why.size());
        _exit(exit_code(ErrorCode::usage));
    }
    begin_child(request.parent, request.memory_limit);
    const ThreadLimit limit(std::max<std::size_t>(1, request.threads));
    RemoteContext context(request.seed);
    try {
        context.send(answer_to(request, context));
    } catch (...) {
        context.send(error_answer(std::current_exception()));
    }
    _exit(0); // destructors of a stage's static objects must not affect the result
}

} // namespace

bool serves_isolated_calls() {
    return serves;
}

void serve_isolated_call(int count, char** arguments) {
    serves = true;
    if (count == 2 && std::string_view(arguments[1]) == child_command) {
        serve();
    }
}

} // namespace foam::runtime
