// What is said between foam and the child process that runs one call of a stage.
#pragma once

#include <foam/context.hpp>
#include <foam/error.hpp>
#include <foam/parameter.hpp>
#include <foam/solid.hpp>
#include <foam/stage.hpp>

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace foam {

/// A call of a stage. What it works on depends on `what`.
struct StageRequest {
    enum class What : std::uint8_t { probe, load, filter, spherize };

    What what = What::probe;
    std::int64_t parent = 0;        ///< process id
    std::uint64_t threads = 1;      ///< at most
    std::uint64_t memory_limit = 0; ///< MiB; 0: none
    std::string plugin;             ///< the file
    std::vector<std::string> used;  ///< files of the plugins whose stages it is made of
    std::string stage;              ///< not for a probe: that only loads the plugin
    std::map<std::string, ParameterValue> given;
    std::uint64_t seed = 0;
    std::string work; ///< load: the file's path; filter: put_mesh(); spherize: put_shape_work()
};

/// Whether serve_isolated_call() was called: a child of this program would answer.
bool serves_isolated_calls();

std::string to_bytes(const StageRequest& request);
/// Throws Error(internal) for bytes that are none.
StageRequest request_from(std::string_view bytes);

void put_shape_work(std::string& out, const Shape& shape, std::span<const Budget> budgets);
/// The shape is built anew from its parts: the same input, so the same shape.
struct ShapeCall {
    Shape shape;
    std::vector<Budget> budgets;
};
ShapeCall shape_call_from(std::string_view bytes);

/// First byte of a message from the child.
enum class Answer : char { progress = 'p', log = 'l', metric = 'm', result = 'r', error = 'e' };

/// What can be thrown, by the kinds that described() tells apart.
enum class Thrown : std::uint8_t { error, bad_alloc, exception, other };

/// An answer that says what `thrown` is; and the same, thrown again on the other side.
std::string error_answer(std::exception_ptr thrown);
[[noreturn]] void rethrow_answer(std::string_view rest);

} // namespace foam
