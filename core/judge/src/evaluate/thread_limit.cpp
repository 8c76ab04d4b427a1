#include <foam/judge/evaluate.hpp>

#include <tbb/global_control.h>

namespace foam::inline judge {

struct ThreadLimit::State {
    tbb::global_control control;
};

ThreadLimit::ThreadLimit(std::size_t threads)
    : state_(threads > 0 ? new State{{tbb::global_control::max_allowed_parallelism, threads}} : nullptr) {}
ThreadLimit::~ThreadLimit() = default;

} // namespace foam::judge
