#include "process.hpp"

#include "input/inputs.hpp"
#include "process/process.hpp"

#include <foam/runtime/internal/bytes.hpp>
#include <foam/runtime/internal/child.hpp>
#include <foam/runtime/process.hpp>

#include <fmt/format.h>

#include <unistd.h>

#include <algorithm>

namespace foam::inline runtime {
namespace {

constexpr bool sanitized = std::string_view(FOAM_ABI_SANITIZER) != "none";

bool is_isolated(const Isolation& isolation) {
    return isolation.process.value_or(false);
}

/// Returns the isolation that the recipe sets, by default the one that the stage requests.
Isolation isolation_of(const Calls& calls, const StageCall& call) {
    const RegisteredStage* stage = calls.registry.find(call.stage);
    Isolation wish = stage ? stage->info.isolation : Isolation{};
    if (sanitized) {
        wish.memory_limit.reset(); // it cannot be enforced, and the user did not request it
    }
    return call.isolation.over(wish);
}

/// Returns the plugin's file: the child loads this one, those it uses, and no other.
std::string plugin_file(const Registry& registry, const std::string& stage) {
    for (const PluginRecord& record : registry.plugins()) {
        if (std::find(record.stages.begin(), record.stages.end(), stage) != record.stages.end()) {
            return record.file.string();
        }
    }
    throw Error(ErrorCode::internal,
                fmt::format("stage '{}' comes from no plugin's file, so it cannot be isolated", stage));
}

/// Handles a message from the child. Returns true if it is the result or a thrown error.
bool take_message(std::string_view message, Context& context, std::string& result, std::exception_ptr& thrown) {
    const auto kind = static_cast<Answer>(message.empty() ? '\0' : message.front());
    const std::string_view rest = message.substr(message.empty() ? 0 : 1);
    ByteReader in(rest);
    switch (kind) {
    case Answer::progress:
        context.progress(in.take<double>());
        return false;
    case Answer::log: {
        const auto severity = in.take<Severity>();
        context.log(severity, in.take_text());
        return false;
    }
    case Answer::metric: {
        const std::string name = in.take_text();
        const auto value = in.take<double>();
        context.metric(name, value, in.take_text());
        return false;
    }
    case Answer::result:
        result = rest;
        return true;
    case Answer::error:
        try {
            rethrow_answer(rest);
        } catch (...) {
            thrown = std::current_exception();
        }
        return true;
    }
    return false; // the stage wrote to a descriptor that it must not use
}

/// Returns a remedy for a call that failed; empty if there is none in general.
std::string remedy_of(const StageRequest& request) {
    return request.what == StageRequest::What::load
               ? "; remedy: the file may be damaged: export it again, or as STL, OBJ, PLY, DAE, OFF or GLB"
               : "";
}

/// Returns the error for a child that gave no answer.
Error bad_end(const ChildEnd& end, const Isolation& isolation, const StageRequest& request) {
    const std::string memory =
        isolation.memory_limit
            ? fmt::format("; its memory_limit of {} MiB may be too little for it", *isolation.memory_limit)
            : "";
    switch (end.why) {
    case ChildEnd::Why::cancelled:
        return {ErrorCode::cancelled, "cancelled; nothing was written"};
    case ChildEnd::Why::too_long:
        return {ErrorCode::geometry, fmt::format("the stage took longer than its time_limit of {} s and was stopped; "
                                                 "remedy: raise the limit, or simplify the input",
                                                 to_text(isolation.time_limit.value_or(0)))};
    case ChildEnd::Why::signalled:
        return {ErrorCode::plugin,
                fmt::format("the stage crashed in its own process ({}){}{}", signal_text(end.number), memory,
                            remedy_of(request))};
    case ChildEnd::Why::exited:
    case ChildEnd::Why::answered:
        break;
    }
    return {ErrorCode::plugin,
            fmt::format("the stage ended its own process (exit code {}) without a result{}{}", end.number, memory,
                        remedy_of(request))};
}

/// Returns the answer to a request. Throws what the stage has thrown, and Error for a child that gave no answer.
std::string call_in_child(const Calls& calls, StageRequest request, const Isolation& isolation, Context& context) {
    const std::filesystem::path program = !calls.options.program.empty() ? calls.options.program
                                          : serves_isolated_calls()      ? "/proc/self/exe"
                                                                         : "";
    if (program.empty()) {
        throw Error(ErrorCode::usage,
                    fmt::format("this program cannot run stages in child processes; remedy: {}, or run it with foam",
                                calls.registry.find(request.stage)->info.isolation.process.value_or(false)
                                    ? fmt::format("set isolate: none for {}", request.stage)
                                    : "delete 'isolate' from the recipe"));
    }
    if (isolation.memory_limit && sanitized) {
        throw Error(ErrorCode::usage, "a foam built with a sanitizer cannot enforce a memory_limit; remedy: delete it");
    }
    request.parent = getpid();
    request.plugin = plugin_file(calls.registry, request.stage);
    for (const std::string& used : calls.registry.find(request.stage)->info.uses) {
        if (calls.registry.find(used)) {
            request.used.push_back(plugin_file(calls.registry, used));
        }
    }
    request.memory_limit = isolation.memory_limit.value_or(0);
    request.seed = context.seed();
    // Children that run at the same time share the cores.
    request.threads = std::max<std::size_t>(1, thread_count() / (running_children() + 1));

    std::string result;
    std::exception_ptr thrown;
    ChildLimits limits;
    limits.seconds = isolation.time_limit;
    limits.cancelled = [&] { return context.cancelled(); };
    const ChildEnd end = run_child(program, to_bytes(request), limits, [&](std::string_view message) {
        return take_message(message, context, result, thrown);
    });
    if (end.why != ChildEnd::Why::answered) {
        throw bad_end(end, isolation, request);
    }
    try {
        if (thrown) {
            std::rethrow_exception(thrown);
        }
    } catch (const std::bad_alloc&) {
        if (isolation.memory_limit) {
            throw Error(ErrorCode::geometry, fmt::format("the stage needs more memory than its memory_limit of {} MiB; "
                                                         "remedy: raise the limit, or simplify the input",
                                                         *isolation.memory_limit));
        }
        throw;
    }
    return result;
}

[[noreturn]] void fail_damaged() {
    throw Error(ErrorCode::internal, "the answer of the stage's own process is damaged");
}

Mesh mesh_from(const std::string& bytes) {
    ByteReader in(bytes);
    Mesh mesh = take_mesh(in);
    if (!in.good() || !in.at_end()) {
        fail_damaged();
    }
    return mesh;
}

Mesh filter_as_is(const Workspace& workspace, const StageCall& call, const Mesh& mesh, Context& context) {
    const Isolation isolation = isolation_of(workspace, call);
    if (!is_isolated(isolation)) {
        return workspace.registry.make<MeshFilter>(call.stage, call.given)->apply(mesh, context);
    }
    StageRequest request;
    request.what = StageRequest::What::filter;
    request.stage = call.stage;
    request.given = call.given;
    put_mesh(request.work, mesh);
    return mesh_from(call_in_child(workspace, std::move(request), isolation, context));
}

/// Continues a search. After an exception the next call starts it anew.
std::vector<SphereTree> continued(const Workspace& workspace, const StageCall& call, StartedSearch& started,
                                  const Shape& shape, std::span<const Budget> budgets, Context& context) {
    if (!started.stage) {
        started.stage = workspace.registry.make<Spherizer>(call.stage, call.given);
    }
    std::unique_ptr<SphereSearch> search = std::move(started.search);
    if (!search) {
        search = started.stage->search(shape);
    }
    std::vector<SphereTree> trees = search->at_most(budgets, context);
    started.search = std::move(search);
    return trees;
}

std::vector<SphereTree> spherize_as_is(const Workspace& workspace, const StageCall& call, StartedSearch& started,
                                       const Shape& shape, std::span<const Budget> budgets, Context& context) {
    const Isolation isolation = isolation_of(workspace, call);
    if (!is_isolated(isolation)) {
        return continued(workspace, call, started, shape, budgets, context);
    }
    StageRequest request;
    request.what = StageRequest::What::spherize;
    request.stage = call.stage;
    request.given = call.given;
    put_shape_work(request.work, shape, budgets);
    const std::string bytes = call_in_child(workspace, std::move(request), isolation, context);
    ByteReader in(bytes);
    std::vector<SphereTree> trees;
    for (auto count = in.take<std::uint64_t>(); count > 0 && in.good(); --count) {
        trees.push_back(take_tree(in));
    }
    if (!in.good() || !in.at_end()) {
        fail_damaged();
    }
    return trees;
}

} // namespace

Mesh call_loader(const Calls& calls, const StageCall& call, const std::filesystem::path& file, Context& context) {
    const Isolation isolation = isolation_of(calls, call);
    if (!is_isolated(isolation)) {
        return calls.registry.make<MeshLoader>(call.stage, call.given)->load(file, context);
    }
    StageRequest request;
    request.what = StageRequest::What::load;
    request.stage = call.stage;
    request.given = call.given;
    request.work = std::filesystem::absolute(file).string();
    return mesh_from(call_in_child(calls, std::move(request), isolation, context));
}

Mesh call_filter(const Workspace& workspace, const StageCall& call, const Mesh& mesh, Context& context) {
    const geometry::OwnFrame frame = frame_for_stage(geometry::own_frame(mesh), call, workspace.registry);
    if (frame.is_given()) {
        return filter_as_is(workspace, call, mesh, context);
    }
    FrameContext framed(context, frame);
    return frame.from_own(
        filter_as_is(workspace, call_in_frame(call, frame, workspace.registry), frame.to_own(mesh), framed));
}

std::vector<SphereTree> call_spherizer(const Workspace& workspace, const StageCall& call, StartedSearch& started,
                                       const Shape& shape, const geometry::OwnFrame& frame,
                                       std::span<const Budget> budgets, Context& context) {
    if (frame.is_given()) {
        return spherize_as_is(workspace, call, started, shape, budgets, context);
    }
    FrameContext framed(context, frame);
    std::vector<SphereTree> trees = spherize_as_is(workspace, call_in_frame(call, frame, workspace.registry), started,
                                                   shape, budgets_in_frame(budgets, frame), framed);
    for (SphereTree& tree : trees) {
        tree = frame.from_own(std::move(tree));
    }
    return trees;
}

void add_isolation(Hasher& hasher, const Isolation& isolation) {
    hasher.add(static_cast<std::uint64_t>(is_isolated(isolation)));
    hasher.add(isolation.time_limit.value_or(0));
    hasher.add(static_cast<std::uint64_t>(isolation.memory_limit.value_or(0)));
}

std::string why_loading_ends_badly(const std::filesystem::path& program, const std::filesystem::path& plugin,
                                   double seconds) {
    StageRequest request;
    request.parent = getpid();
    request.plugin = std::filesystem::absolute(plugin).string();
    ChildLimits limits;
    limits.seconds = seconds;
    const ChildEnd end = run_child(program, to_bytes(request), limits, [](std::string_view) { return true; });
    switch (end.why) {
    case ChildEnd::Why::answered:
    case ChildEnd::Why::cancelled:
        return "";
    case ChildEnd::Why::too_long:
        return fmt::format("loading it did not end within {} s; remedy: correct its entry point and the constructors "
                           "of its static objects",
                           to_text(seconds));
    case ChildEnd::Why::signalled:
        return fmt::format("it crashes while it is loaded ({}); remedy: correct its entry point and the constructors "
                           "of its static objects",
                           signal_text(end.number));
    case ChildEnd::Why::exited:
        break;
    }
    return fmt::format("it ends the program while it is loaded (exit code {}); remedy: correct its entry point and "
                       "the constructors of its static objects",
                       end.number);
}

} // namespace foam::runtime
