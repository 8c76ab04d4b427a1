// Experiments: measurements over meshes, robots and stages, described by a YAML file, reported as tables and plots.
#pragma once

#include <foam/recipe/recipe.hpp>

#include <atomic>
#include <filesystem>
#include <functional>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] bench {

namespace experiment {
class Bench;
struct Outcome;
} // namespace experiment

/// A checked experiment, ready to run. Each kind derives from it.
class Experiment {
public:
    virtual ~Experiment();
    Experiment(const Experiment&) = delete;
    Experiment& operator=(const Experiment&) = delete;

    std::filesystem::path file; ///< relative references start at its folder
    std::string source;         ///< its text
    std::string kind, name, title;

    /// Returns the names of all stages that it measures.
    virtual std::set<std::string> stages() const = 0;
    /// Runs the measurements. Throws Error naming stage and input.
    virtual experiment::Outcome run(experiment::Bench& bench) const = 0;

protected:
    Experiment();
};

/// The result of reading; the experiment is present only if the findings contain no error.
struct ExperimentReading {
    std::unique_ptr<const Experiment> experiment;
    std::vector<Diagnostic> diagnostics;
    bool ok() const { return experiment != nullptr; }
};

/// Reads and checks an experiment. Never throws for errors in the text: all findings are returned at once.
ExperimentReading read_experiment(const std::filesystem::path& file, const Registry& registry);
ExperimentReading parse_experiment(const std::string& text, const std::filesystem::path& file,
                                   const Registry& registry);

struct ExperimentOptions {
    std::filesystem::path out; ///< folder for the results; empty: nothing is written
    std::size_t threads = 1;   ///< for the stages; 0: all cores
    const std::atomic<bool>* cancel = nullptr;
    /// Called with a line before and after each measurement.
    std::function<void(const std::string& line)> tell;
};

struct ExperimentResult {
    std::string csv;                          ///< results.csv: one line per measurement
    std::string markdown;                     ///< results.md: tables, figures, and the machine and versions behind them
    std::vector<std::filesystem::path> files; ///< written, relative to the folder
};

/// Runs the experiment. On an exception or cancellation the folder is as it was before.
ExperimentResult run_experiment(const Experiment& experiment, const Registry& registry,
                                const ExperimentOptions& options = {});

} // namespace bench
} // namespace foam
