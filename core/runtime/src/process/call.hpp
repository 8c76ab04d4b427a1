// The protocol between foam and the child process that runs one call of a stage.
#pragma once

#include <foam/base/error.hpp>
#include <foam/geometry/solid.hpp>
#include <foam/sdk/context.hpp>
#include <foam/sdk/parameter.hpp>
#include <foam/sdk/stage.hpp>

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
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

} // namespace foam::runtime
