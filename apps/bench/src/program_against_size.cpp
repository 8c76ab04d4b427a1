// kind: program_against_size. CPU time and memory of whole runs of `foam spherize` against triangles or spheres.
#include "bench.hpp"
#include "input_mesh.hpp"
#include "kinds.hpp"
#include "measured_program.hpp"
#include "power_law.hpp"
#include "reference.hpp"
#include "sized_mesh.hpp"
#include "stl.hpp"

#include <foam/base/error.hpp>
#include <foam/base/internal/files.hpp>
#include <foam/recipe/internal/yaml.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <limits>

namespace foam::inline bench::experiment {
namespace {

using namespace reading;
using Points = std::vector<std::pair<double, double>>;

/// A way to call the program.
struct Call {
    std::string label;
    std::vector<std::string> settings; ///< of --set
};

/// One mesh by one call with one number of spheres.
struct Run {
    std::size_t triangles = 0, spheres = 0;
    std::vector<MeasuredProgram> repeats;
    double excess = 0;
    bool certified = false;
    std::string left_out; ///< why it was not measured

    double x(bool against_spheres) const { return static_cast<double>(against_spheres ? spheres : triangles); }
    /// The median of a quantity over the repeats.
    double median(double MeasuredProgram::*quantity) const {
        std::vector<double> values;
        for (const MeasuredProgram& run : repeats) {
            values.push_back(run.*quantity);
        }
        std::sort(values.begin(), values.end());
        const std::size_t half = values.size() / 2;
        return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
    }
};

struct CallCurve {
    const Call* call;
    std::vector<Run> runs;

    Points points(double MeasuredProgram::*quantity, double factor, bool against_spheres) const {
        Points result;
        for (const Run& run : runs) {
            if (!run.repeats.empty()) {
                result.emplace_back(run.x(against_spheres), factor * run.median(quantity));
            }
        }
        return result;
    }
};

std::string growth_of(const Points& points) {
    const auto law = fitted_power_law(points);
    return law ? fmt::format("n^{:.2f}", law->exponent) : "–";
}

class ProgramAgainstSize final : public Experiment {
public:
    MeshCandidates mesh;
    std::vector<std::size_t> triangles, spheres; ///< one of them has one number; no triangles: the mesh as it is
    std::vector<Call> calls;
    std::vector<Reference> references;
    std::size_t repeats = 3;
    double time_limit = 60; ///< s

    std::set<std::string> stages() const override { return {}; }

    Outcome run(Bench& bench) const override {
        std::string chosen;
        const std::vector<Run> cases = make_cases(bench, chosen);
        std::vector<CallCurve> curves;
        for (const Call& call : calls) {
            curves.push_back(measured(bench, call, cases));
        }
        Outcome outcome;
        outcome.sections.push_back({"", method_text(chosen), "", {}});
        add_cases(curves, outcome.cases);
        add_section("CPU time", "CPU s", "time.svg", &MeasuredProgram::cpu_seconds, 1, curves, true, outcome);
        add_section("Memory", "MB", "memory.svg", &MeasuredProgram::memory, 1e-6, curves, false, outcome);
        add_excess(curves, outcome);
        return outcome;
    }

private:
    bool against_spheres() const { return spheres.size() > 1; }

    static std::filesystem::path file_of(const Bench& bench, std::size_t triangles) {
        return bench.scratch() / fmt::format("mesh_{}.stl", triangles);
    }

    /// The runs to measure; their meshes are files then.
    std::vector<Run> make_cases(const Bench& bench, std::string& chosen) const {
        const Mesh raw = input_mesh(bench, *this, mesh, chosen);
        LimitedContext context(bench, std::numeric_limits<double>::infinity());
        std::vector<Run> cases;
        for (const std::size_t count : triangles.empty() ? std::vector{raw.triangles.size()} : triangles) {
            bench.check_cancelled();
            const Mesh sized_mesh = triangles.empty() ? raw : sized(raw, count, bench.registry(), context);
            write_file(file_of(bench, sized_mesh.triangles.size()), to_binary_stl(sized_mesh));
            for (const std::size_t number : spheres) {
                Run run;
                run.triangles = sized_mesh.triangles.size();
                run.spheres = number;
                cases.push_back(std::move(run));
            }
        }
        return cases;
    }

    CallCurve measured(const Bench& bench, const Call& call, const std::vector<Run>& cases) const {
        CallCurve curve{&call, {}};
        bool over = false;
        for (Run run : cases) {
            if (over) {
                run.left_out = "left out";
            } else {
                measure(bench, call, run);
                over = run.repeats.empty() || run.repeats.front().cpu_seconds > time_limit;
                bench.tell(fmt::format("{}: {}, {} triangles, {} spheres: {}", name, call.label, run.triangles, run.spheres,
                                       run.repeats.empty()
                                           ? run.left_out
                                           : short_number(run.median(&MeasuredProgram::cpu_seconds)) + " s"));
            }
            curve.runs.push_back(std::move(run));
        }
        return curve;
    }

    /// Repeats, as far as the time limit goes over all of them.
    void measure(const Bench& bench, const Call& call, Run& run) const {
        std::vector<std::string> arguments{"spherize", file_of(bench, run.triangles).string(), "-n",
                                           fmt::format("{}", run.spheres), "-j", "1", "--fresh", "--json", "-o",
                                           (bench.scratch() / "spheres.json").string(), "--force"};
        for (const std::string& setting : call.settings) {
            arguments.insert(arguments.end(), {"--set", setting});
        }
        double spent = 0;
        while (run.repeats.size() < repeats && spent <= time_limit) {
            bench.check_cancelled();
            MeasuredProgram done = run_measured(foam_program(), arguments, time_limit, bench.scratch());
            if (done.over_limit) {
                run.left_out = run.repeats.empty() ? fmt::format("over {:g} s", time_limit) : "";
                return;
            }
            if (done.exit_code != 0) {
                throw Error(ErrorCode::geometry, fmt::format("{}, {} triangles, {} spheres: exit code {}: {}", call.label,
                                                             run.triangles, run.spheres, done.exit_code, done.errors));
            }
            const nlohmann::json summary = nlohmann::json::parse(done.output);
            run.excess = summary.at("total").at("excess").get<double>();
            run.certified = summary.at("certified").get<bool>();
            spent += done.cpu_seconds;
            run.repeats.push_back(std::move(done));
        }
    }

    std::string method_text(const std::string& chosen) const {
        std::string text = fmt::format(
            "The mesh is {}{} Each measurement is a process `foam spherize` of its own, from the start to the written file, "
            "with its proof, on one thread and without the cache, up to {} times: the median of its CPU seconds, user and "
            "system, and of the most memory that was resident. A case that takes more than {:g} s is the last of its "
            "curve. Growth is the exponent of n in the law fitted by least squares to the logarithms, over the sizes from "
            "a tenth of the curve's largest on.",
            chosen,
            triangles.empty() ? "." : "; simplify.quadric takes it down to a number of triangles, splitting longest edges "
                                      "takes it up.",
            repeats, time_limit);
        for (const Call& call : calls) {
            text += fmt::format(" {}: {}.", call.label,
                                call.settings.empty() ? "as it is" : fmt::format("{}", fmt::join(call.settings, ", ")));
        }
        return text;
    }

    static void add_cases(const std::vector<CallCurve>& curves, Table& table) {
        table.columns = {"curve", "triangles", "spheres", "cpu_seconds", "memory_mb", "excess", "certified", "repeats",
                         "remark"};
        for (const CallCurve& curve : curves) {
            for (const Run& run : curve.runs) {
                const bool there = !run.repeats.empty();
                table.rows.push_back({curve.call->label, std::to_string(run.triangles), std::to_string(run.spheres),
                                      there ? fmt::format("{:.3f}", run.median(&MeasuredProgram::cpu_seconds)) : "",
                                      there ? fmt::format("{:.1f}", 1e-6 * run.median(&MeasuredProgram::memory)) : "",
                                      there ? fmt::format("{:.4f}", run.excess) : "",
                                      there ? (run.certified ? "yes" : "no") : "", std::to_string(run.repeats.size()),
                                      run.left_out});
            }
        }
    }

    std::vector<std::string> size_columns(const CallCurve& curve, const std::string& first) const {
        std::vector<std::string> columns{first};
        for (const Run& run : curve.runs) {
            columns.push_back(std::to_string(against_spheres() ? run.spheres : run.triangles));
        }
        return columns;
    }

    void add_section(const std::string& what, const std::string& unit, const std::string& figure,
                     double MeasuredProgram::*quantity, double factor, const std::vector<CallCurve>& curves,
                     bool with_references, Outcome& outcome) const {
        Section section{.title = what, .text = {}, .figure = figure, .table = {}};
        section.table.columns = size_columns(curves.front(), unit);
        section.table.columns.emplace_back("growth");
        plot::Plot picture{.title = title,
                           .x = {.label = against_spheres() ? "spheres" : "triangles", .logarithmic = true, .ticks = {}},
                           .y = {.label = fmt::format("{}, {}", what, unit), .logarithmic = true, .ticks = {}},
                           .panels = std::vector<plot::Panel>(1)};
        const auto draw = [&](const std::string& label, const Points& points, bool reference) {
            const auto law = fitted_power_law(points);
            picture.panels[0].series.push_back(
                {law ? fmt::format("{}, {}", label, growth_of(points)) : label, points, reference});
        };
        for (const CallCurve& curve : curves) {
            const Points points = curve.points(quantity, factor, against_spheres());
            std::vector<std::string> row{curve.call->label};
            for (const Run& run : curve.runs) {
                row.push_back(run.repeats.empty() ? run.left_out : short_number(factor * run.median(quantity)));
            }
            row.push_back(growth_of(points));
            section.table.rows.push_back(std::move(row));
            draw(curve.call->label, points, false);
        }
        if (with_references) {
            for (const Reference& reference : references) {
                if (const auto found = find_reference(reference, file); !found.empty()) {
                    const Points points = load_reference(reference, found);
                    section.text += fmt::format("{}: {} published times, growth {}. ", reference.label, points.size(),
                                                growth_of(points));
                    draw(reference.label, points, true);
                } else {
                    section.text += fmt::format("Left out, its file is not here: {} ({}). ", reference.label,
                                                fmt::join(reference.files, ", "));
                }
            }
        }
        outcome.figures.push_back({figure, std::move(picture)});
        outcome.sections.push_back(std::move(section));
    }

    void add_excess(const std::vector<CallCurve>& curves, Outcome& outcome) const {
        Section section{.title = "Excess", .text = "All are certified, unless a number says otherwise.", .figure = {}, .table = {}};
        section.table.columns = size_columns(curves.front(), "excess");
        for (const CallCurve& curve : curves) {
            std::vector<std::string> row{curve.call->label};
            for (const Run& run : curve.runs) {
                row.push_back(run.repeats.empty() ? run.left_out
                                                  : fmt::format("{:.3f}{}", run.excess, run.certified ? "" : " (not certified)"));
            }
            section.table.rows.push_back(std::move(row));
        }
        outcome.sections.push_back(std::move(section));
    }
};

/// Reads curves: LABEL: {key.path: value, …}.
std::vector<Call> read_calls(const Value& value, const Checking& checking) {
    std::vector<Call> calls;
    if (!expect_map(value, "curves", "curves: {normal: {}, fast: {stages.spherize.cover.effort: fast}}",
                    checking.findings)) {
        return calls;
    }
    for (std::size_t i = 0; i < value.keys.size(); ++i) {
        Call call{value.keys[i].text, {}};
        const Value& settings = value.items[i];
        if (expect_map(settings, call.label, "fast: {stages.spherize.cover.effort: fast}", checking.findings)) {
            for (std::size_t k = 0; k < settings.keys.size(); ++k) {
                call.settings.push_back(fmt::format("{}={}", settings.keys[k].text, settings.items[k].text));
            }
        }
        calls.push_back(std::move(call));
    }
    if (calls.empty()) {
        checking.findings.error(value.where, "wrong-type", "'curves' expects at least one curve");
    }
    return calls;
}

} // namespace

std::unique_ptr<Experiment> read_program_against_size(const Value& root, const Checking& checking) {
    auto experiment = std::make_unique<ProgramAgainstSize>();
    Findings& findings = checking.findings;
    const auto values = read_kind_values(
        root,
        {Parameter::integer("repeats", 3).bounds(1, 1000), Parameter::number("time_limit", 60).bounds(0.001, 1e6).unit("s")},
        {"mesh", "triangles", "spheres", "curves", "references"}, checking);
    take(values, "repeats", experiment->repeats);
    take(values, "time_limit", experiment->time_limit);
    if (const Value* mesh = required(root, "mesh", "mesh: FILE", findings)) {
        experiment->mesh = {read_references(*mesh, "mesh", findings), findings.locate(mesh->where)};
    }
    if (const Value* triangles = root.find("triangles")) {
        experiment->triangles = read_counts(*triangles, "triangles", 4, 2e7, findings);
    }
    if (const Value* spheres = required(root, "spheres", "spheres: [8]", findings)) {
        experiment->spheres = read_counts(*spheres, "spheres", 1, 1e6, findings);
        if (experiment->spheres.size() > 1 && experiment->triangles.size() > 1) {
            findings.error(spheres->where, "conflict",
                           "several numbers of triangles and of spheres; remedy: two experiments, each with one of them");
        }
    }
    if (const Value* curves = required(root, "curves", "curves: {normal: {}}", findings)) {
        experiment->calls = read_calls(*curves, checking);
    }
    if (const Value* references = root.find("references")) {
        experiment->references = read_reference_list(*references, findings);
    }
    return experiment;
}

} // namespace foam::bench::experiment
