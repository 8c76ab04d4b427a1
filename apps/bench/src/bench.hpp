// What a running experiment may use, and what it hands back.
#pragma once

#include "table.hpp"

#include <foam/bench/experiment.hpp>
#include <foam/report/internal/plot.hpp>
#include <foam/sdk/context.hpp>

#include <fmt/format.h>

#include <chrono>
#include <string>
#include <vector>

namespace foam::inline bench::experiment {

/// CPU seconds, user and system, that this process has used so far, over all its threads.
double cpu_seconds();

/// Belongs to one run of an experiment. Experiments measure one thing at a time.
class Bench {
public:
    Bench(const Registry& registry, const ExperimentOptions& options, std::filesystem::path scratch)
        : registry_(registry), options_(options), scratch_(std::move(scratch)) {}

    const Registry& registry() const { return registry_; }
    const std::atomic<bool>* cancel() const { return options_.cancel; }
    bool cancelled() const { return options_.cancel && options_.cancel->load(std::memory_order_relaxed); }
    /// Throws Error(cancelled) once the user has asked to stop.
    void check_cancelled() const;
    /// A line for people who wait.
    void tell(const std::string& line) const;
    /// A folder for files that measurements need; gone at the end.
    const std::filesystem::path& scratch() const { return scratch_; }

private:
    const Registry& registry_;
    const ExperimentOptions& options_;
    std::filesystem::path scratch_;
};

/// The context of a stage that is to stop once it has used more CPU time than it may.
class LimitedContext final : public Context {
public:
    /// `limit`: s, from now on.
    LimitedContext(const Bench& bench, double limit);
    std::uint64_t seed() const override { return 0; }
    bool cancelled() const override;
    void progress(double) override {}
    void log(Severity, std::string_view) override {}
    void metric(std::string_view, double, std::string_view) override {}
    /// Whether the limit is behind cancelled().
    bool over_limit() const { return over_limit_.load(std::memory_order_relaxed); }

private:
    using Clock = std::chrono::steady_clock;
    const Bench& bench_;
    double end_;
    /// The CPU clock is a system call: it is asked a few times a second only.
    mutable std::atomic<Clock::rep> next_look_{0};
    mutable std::atomic<bool> over_limit_{false};
};

/// A part of results.md: text, a figure, a table; what is empty is left out.
struct Section {
    std::string title, text, figure; ///< figure: file name
    Table table;
};

struct PlotFigure {
    std::string file;
    plot::Plot plot;
};

struct Picture {
    std::string file, bytes;
};

struct Outcome {
    Table cases; ///< results.csv: a row for each measurement
    std::vector<Section> sections;
    std::vector<PlotFigure> figures; ///< plots
    std::vector<Picture> pictures;   ///< other figures, encoded
};

/// "0.0123": three digits that count, at most six behind the point; "–" for what is not finite.
std::string short_number(double value);

} // namespace foam::bench::experiment
