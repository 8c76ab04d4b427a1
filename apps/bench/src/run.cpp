#include "report.hpp"

#include <foam/base/parallel.hpp>
#include <foam/runtime/internal/output.hpp>
#include <foam/runtime/scratch_folder.hpp>

#include <optional>

namespace foam::inline bench {

ExperimentResult run_experiment(const Experiment& experiment, const Registry& registry,
                                const ExperimentOptions& options) {
    const ThreadLimit limit(options.threads);
    constexpr const char* csv = "results.csv";
    std::optional<RunDirectory> directory;
    if (!options.out.empty()) {
        directory.emplace(options.out);
    }
    const ScratchFolder scratch;
    experiment::Bench bench(registry, options, scratch.path());
    const experiment::Outcome outcome = experiment.run(bench);
    bench.check_cancelled();

    ExperimentResult result;
    result.csv = to_csv(outcome.cases);
    const experiment::Table measured_on = experiment::circumstances(experiment, registry, options.threads);
    result.markdown = to_markdown(experiment, outcome, measured_on);
    if (directory) {
        const auto write = [&](const std::filesystem::path& file, const std::string& bytes) {
            directory->write(file, bytes);
            result.files.push_back(file);
        };
        write(csv, result.csv);
        write("results.md", result.markdown);
        write("measured_on.csv", to_csv(measured_on));
        for (const experiment::PlotFigure& figure : outcome.figures) {
            write(figure.file, plot::to_svg(figure.plot));
        }
        for (const experiment::Picture& picture : outcome.pictures) {
            write(picture.file, picture.bytes);
        }
        bench.check_cancelled();
        directory->commit();
    }
    return result;
}

} // namespace foam::bench
