// Mesh in memory to certified spheres, or to one other element, in memory: median and 99th percentile of single calls.
#include <foam/base/parallel.hpp>
#include <foam/runtime/contract.hpp>
#include <foam/sdk/kinds.hpp>
#include <foam/search/cover.hpp>
#include <foam/search/sphere_cache.hpp>

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>

namespace {

using namespace foam;

constexpr std::int64_t calls = 200;

/// 5184 triangles, closed.
Mesh torus() {
    return sample::torus(0.1, 0.04, 72, 36);
}

double percentile(const std::vector<double>& values, double share) {
    std::vector<double> sorted = values;
    std::sort(sorted.begin(), sorted.end());
    const auto last = static_cast<double>(sorted.size() - 1);
    return sorted[static_cast<std::size_t>(std::ceil(share * last))];
}

void report_p99(benchmark::internal::Benchmark* benchmark) {
    // One call an iteration and one iteration a repetition: percentiles are those of calls.
    benchmark->Iterations(1)->Repetitions(calls)->ReportAggregatesOnly()->Unit(benchmark::kMillisecond)->UseRealTime();
    benchmark->ComputeStatistics("p99", [](const std::vector<double>& values) { return percentile(values, 0.99); });
}

/// Arguments: spheres, threads (0: all).
void spherize_torus(benchmark::State& state) {
    const ThreadLimit limit(static_cast<std::size_t>(state.range(1)));
    const Mesh mesh = torus();
    SphereCover cover;
    for (auto _ : state) {
        cover = spherize(mesh, static_cast<std::size_t>(state.range(0)), {.effort = Effort::fast});
    }
    state.counters["excess"] = cover.volume / signed_volume(mesh) - 1;
    state.counters["certified"] = cover.certificate.holds;
}
BENCHMARK(spherize_torus)->ArgNames({"spheres", "threads"})->ArgsProduct({{8, 16}, {1, 0}})->Apply(report_p99);

/// Argument: the kind of the one element. On one thread.
void one_element_around_torus(benchmark::State& state) {
    const ThreadLimit limit(1);
    const Mesh mesh = torus();
    const auto kind = static_cast<Element::Kind>(state.range(0));
    Cover cover;
    for (auto _ : state) {
        cover = foam::cover(mesh, 1, {.kinds = {kind}, .effort = Effort::fast});
    }
    state.SetLabel(noun_of(kind, 1));
    state.counters["excess"] = cover.volume / signed_volume(mesh) - 1;
    state.counters["certified"] = cover.certificate.holds;
}
BENCHMARK(one_element_around_torus)->DenseRange(1, 5)->Apply(report_p99);

void known_torus(benchmark::State& state) {
    const Mesh mesh = torus();
    SphereCache cache;
    cache.spherize(mesh, 8, {.effort = Effort::fast});
    for (auto _ : state) {
        benchmark::DoNotOptimize(cache.spherize(mesh, 8, {.effort = Effort::fast}));
    }
}
BENCHMARK(known_torus)->Apply(report_p99);

} // namespace

BENCHMARK_MAIN();
