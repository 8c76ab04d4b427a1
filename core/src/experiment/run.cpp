#include "report.hpp"
#include "run/run_directory.hpp"

#include <foam/error.hpp>

#include <fmt/format.h>
#include <tbb/global_control.h>

#include <cstdlib>
#include <optional>

namespace foam {
namespace {

namespace fs = std::filesystem;

/// A folder that is gone at the end, after a crash too.
class Scratch {
public:
    Scratch() : path_(made()), unfinished_(path_) {}
    ~Scratch() {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }
    Scratch(const Scratch&) = delete;
    Scratch& operator=(const Scratch&) = delete;
    const fs::path& path() const { return path_; }

private:
    static fs::path made() {
        std::string pattern = (fs::temp_directory_path() / "foam-bench-XXXXXX").string();
        if (!mkdtemp(pattern.data())) {
            throw Error(ErrorCode::output,
                        fmt::format("no folder can be made in {}", fs::temp_directory_path().string()));
        }
        return pattern;
    }

    fs::path path_;
    UnfinishedFolder unfinished_;
};

} // namespace

ExperimentResult run_experiment(const Experiment& experiment, const Registry& registry,
                                const ExperimentOptions& options) {
    std::optional<tbb::global_control> threads;
    if (options.threads > 0) {
        threads.emplace(tbb::global_control::max_allowed_parallelism, options.threads);
    }
    constexpr const char* csv = "results.csv";
    std::optional<RunDirectory> directory;
    if (!options.out.empty()) {
        directory.emplace(options.out, csv);
    }
    const Scratch scratch;
    experiment::Bench bench(registry, options, scratch.path());
    const experiment::Outcome outcome = experiment.run(bench);
    bench.check_cancelled();

    ExperimentResult result;
    result.csv = to_csv(outcome.cases);
    result.markdown = to_markdown(experiment, outcome, registry, options.threads);
    if (directory) {
        const auto write = [&](const fs::path& file, const std::string& bytes) {
            directory->write(file, bytes);
            result.files.push_back(file);
        };
        write(csv, result.csv);
        write("results.md", result.markdown);
        for (const experiment::Figure& figure : outcome.figures) {
            write(figure.file, plot::to_svg(figure.plot));
        }
        bench.check_cancelled();
        directory->commit();
    }
    return result;
}

} // namespace foam
