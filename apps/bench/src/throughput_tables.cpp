#include "throughput.hpp"

#include <fmt/format.h>

#include <cmath>

namespace foam::inline bench::experiment {
namespace {

struct Mean {
    double value = 0, error = 0;
};

/// With the standard error of the mean.
Mean mean_of(const std::vector<double>& values) {
    const auto n = static_cast<double>(values.size());
    Mean mean;
    for (const double value : values) {
        mean.value += value / n;
    }
    double squares = 0;
    for (const double value : values) {
        squares += (value - mean.value) * (value - mean.value);
    }
    mean.error = values.size() < 2 ? 0 : std::sqrt(squares / (n - 1) / n);
    return mean;
}

std::string with_error(const Mean& mean, int digits) {
    return fmt::format("{:.{}f} ± {:.{}f}", mean.value, digits, mean.error, digits);
}

std::string change(const Mean& mean, const Mean& first) {
    return fmt::format("{:+.0f} %", 100 * (mean.value / first.value - 1));
}

} // namespace

Outcome Throughput::told(const std::vector<GraspModel>& models, const std::vector<std::vector<Measurement>>& results,
                         const std::string& version, const std::string& input, std::size_t excluded) const {
    Outcome outcome;
    outcome.cases = {{"model", "spheres", "repeat", "steps", "wall_seconds", "cpu_seconds", "steps_per_s",
                      "steps_per_cpu_s", "contacts_per_step", "gripped", "lifted", "mean_lift_m"},
                     {}};
    Table table{{"model", "steps a second", "of the original's", "steps a CPU second", "of the original's",
                 "contacts a step", "gripped", "lifted"},
                {}};
    Mean first_wall, first_cpu;
    for (std::size_t m = 0; m < models.size(); ++m) {
        std::vector<double> wall, cpu;
        for (std::size_t r = 0; r < results[m].size(); ++r) {
            const Measurement& one = results[m][r];
            wall.push_back(one.steps / one.wall);
            cpu.push_back(one.steps / one.cpu);
            outcome.cases.rows.push_back({models[m].label, std::to_string(models[m].spheres), std::to_string(r + 1),
                                          fmt::format("{:.0f}", one.steps), fmt::format("{:.4f}", one.wall),
                                          fmt::format("{:.4f}", one.cpu), fmt::format("{:.1f}", wall.back()),
                                          fmt::format("{:.1f}", cpu.back()), fmt::format("{:.3f}", one.contacts),
                                          std::to_string(one.gripped), std::to_string(one.lifted),
                                          fmt::format("{:.4f}", one.lift)});
        }
        const Mean wall_mean = mean_of(wall), cpu_mean = mean_of(cpu);
        if (m == 0) {
            first_wall = wall_mean;
            first_cpu = cpu_mean;
        }
        const Measurement& last = results[m].back();
        table.rows.push_back({models[m].label, with_error(wall_mean, 0), change(wall_mean, first_wall),
                              with_error(cpu_mean, 0), change(cpu_mean, first_cpu),
                              fmt::format("{:.1f}", last.contacts), fmt::format("{} of {}", last.gripped, simulations),
                              fmt::format("{} of {}", last.lifted, simulations)});
    }
    outcome.sections.push_back({"", text_of(version, input, excluded), "", {}});
    outcome.sections.push_back({"", "", "", std::move(table)});
    return outcome;
}

std::string Throughput::text_of(const std::string& version, const std::string& input, std::size_t excluded) const {
    std::string text = fmt::format(
        "{} on {} threads. The robot is {}. {} simulations of {:g} s in steps of {:g} ms, side by side, each with "
        "memory of its own for one model; {} repeat{}, the models in turn. Every model follows the same position "
        "commands: it opens the fingers around a box of {:g} x {:g} x {:g} mm and {:g} kg on a plane, closes them "
        "and lifts. The box begins up to {:g} mm beside its place, at random, the same for all models. ",
        version, threads_used(), input, simulations, motion.back().time, 1e3 * timestep, repeats,
        repeats == 1 ? "" : "s", 1e3 * object.size.x, 1e3 * object.size.y, 1e3 * object.size.z, object.mass,
        1e3 * spread);
    text += fmt::format("Masses and inertias are the same for all. {} pairs of links are not checked against each "
                        "other, in any model: those that the self-collision matrix of one of them leaves out. ",
                        excluded);
    if (!object_ignores.empty()) {
        text += fmt::format("No contact between the box and {}, whose spheres reach to the fingertips in coarse "
                            "models. ",
                            fmt::join(object_ignores, ", "));
    }
    text += fmt::format("MuJoCo takes meshes as their convex hulls. Spheres by {}, grown to cover the original "
                        "geometry. ± is the standard error of the mean. Steps a second go by the wall "
                        "clock; where other programs ran beside, steps a CPU second tell more. Gripped: both "
                        "fingers touch the box at the "
                        "end; lifted: by at least {:g} mm.",
                        method ? method->label : "", 1e3 * lift);
    return text;
}

} // namespace foam::bench::experiment
