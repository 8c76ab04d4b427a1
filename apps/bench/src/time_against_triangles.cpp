// kind: time_against_triangles. CPU time of stages and chains of stages on one mesh in ever more triangles.
#include "bench.hpp"
#include "input_mesh.hpp"
#include "kinds.hpp"
#include "power_law.hpp"
#include "reference.hpp"
#include "sized_mesh.hpp"
#include "stl.hpp"

#include <foam/base/error.hpp>
#include <foam/base/internal/files.hpp>
#include <foam/recipe/internal/yaml.hpp>
#include <foam/runtime/internal/cover.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace foam::inline bench::experiment {
namespace {

using namespace reading;
using Points = std::vector<std::pair<double, double>>;

/// The curves of one picture.
struct Group {
    std::string name; ///< of the file
    std::vector<Chain> curves;
};

/// One chain on one mesh.
struct Case {
    std::size_t asked = 0, triangles = 0;
    std::vector<double> seconds; ///< of each repeat
    std::string left_out;        ///< why there is no time

    double median() const {
        std::vector<double> sorted = seconds;
        std::sort(sorted.begin(), sorted.end());
        const std::size_t half = sorted.size() / 2;
        return sorted.size() % 2 == 1 ? sorted[half] : (sorted[half - 1] + sorted[half]) / 2;
    }
};

struct Curve {
    const Chain* chain;
    std::vector<Case> cases;

    Points points() const {
        Points result;
        for (const Case& c : cases) {
            if (!c.seconds.empty()) {
                result.emplace_back(static_cast<double>(c.triangles), c.median());
            }
        }
        return result;
    }
};

struct SizedMesh {
    std::size_t asked = 0;
    Mesh mesh;
};

std::string growth_text(const Points& points) {
    const auto law = fitted_power_law(points);
    return law ? fmt::format("n^{:.2f}", law->exponent) : "–";
}

class TimeAgainstTriangles final : public Experiment {
public:
    MeshCandidates candidates;
    std::vector<StageCall> prepare;
    std::vector<std::size_t> triangles;
    std::size_t repeats = 3, spheres = 8;
    double time_limit = 10; ///< s
    std::vector<Group> groups;
    std::vector<Reference> references;

    std::set<std::string> stages() const override {
        std::set<std::string> names;
        for (const Group& group : groups) {
            for (const Chain& chain : group.curves) {
                add_names(chain, names);
            }
        }
        return names;
    }

    Outcome run(Bench& bench) const override {
        std::string chosen;
        const std::vector<SizedMesh> meshes = make_meshes(bench, chosen);
        Outcome outcome;
        outcome.cases.columns = {"figure",  "curve", "triangles_wanted", "triangles", "cpu_seconds",
                                 "repeats", "remark"};
        outcome.sections.push_back({"", method_text(chosen, meshes), "", {}});
        for (const Group& group : groups) {
            std::vector<Curve> curves;
            for (const Chain& chain : group.curves) {
                curves.push_back(measured(bench, chain, meshes));
                add_cases(group, curves.back(), outcome.cases);
            }
            add_section(group, curves, outcome);
        }
        return outcome;
    }

private:
    /// The mesh of the experiment in each number of triangles.
    std::vector<SizedMesh> make_meshes(const Bench& bench, std::string& chosen) const {
        LimitedContext context(bench, std::numeric_limits<double>::infinity());
        Mesh raw = input_mesh(bench, *this, candidates, chosen);
        for (const StageCall& call : prepare) {
            raw = bench.registry().make<MeshFilter>(call.stage, call.given)->apply(raw, context);
        }
        std::vector<SizedMesh> meshes;
        for (const std::size_t count : triangles) {
            bench.check_cancelled();
            meshes.push_back({count, sized(raw, count, bench.registry(), context)});
            bench.tell(fmt::format("{}: the mesh in {} triangles, {} wanted", name, meshes.back().mesh.triangles.size(),
                                   count));
        }
        return meshes;
    }

    Curve measured(const Bench& bench, const Chain& chain, const std::vector<SizedMesh>& meshes) const {
        Curve curve{&chain, {}};
        bool over = false;
        for (const SizedMesh& sized : meshes) {
            Case c{sized.asked, sized.mesh.triangles.size(), {}, {}};
            if (over) {
                c.left_out = "left out";
            } else {
                measure(bench, chain, sized.mesh, c);
                over = c.seconds.empty() || c.seconds.front() > time_limit;
                bench.tell(fmt::format("{}: {}, {} triangles: {}", name, chain.label, c.triangles,
                                       c.seconds.empty() ? c.left_out : short_number(c.median()) + " s"));
            }
            curve.cases.push_back(std::move(c));
        }
        return curve;
    }

    /// Repeats, as far as the time limit goes over all of them.
    void measure(const Bench& bench, const Chain& chain, const Mesh& mesh, Case& c) const {
        double spent = 0;
        while (c.seconds.size() < repeats && spent <= time_limit) {
            bench.check_cancelled();
            LimitedContext context(bench, time_limit);
            try {
                c.seconds.push_back(once(bench, chain, mesh, context));
                spent += c.seconds.back();
            } catch (const Error& error) {
                if (error.code() == ErrorCode::cancelled && !bench.cancelled() && context.over_limit()) {
                    if (c.seconds.empty()) {
                        c.left_out = fmt::format("over {:g} s", time_limit);
                    }
                    return;
                }
                throw Error(error.code(), fmt::format("{}, {} triangles: {}", chain.label, c.triangles, error.what()));
            }
        }
    }

    /// CPU seconds of the chain: loaders read a file; a spherizer's time goes from the mesh in memory to spheres that
    /// are proved to cover it.
    double once(const Bench& bench, const Chain& chain, const Mesh& mesh, Context& context) const {
        std::unique_ptr<MeshLoader> loader;
        std::vector<std::unique_ptr<MeshFilter>> filters;
        std::unique_ptr<Spherizer> spherizer;
        const std::filesystem::path mesh_file = bench.scratch() / "mesh.stl";
        if (chain.loader) {
            loader = bench.registry().make<MeshLoader>(chain.loader->stage, chain.loader->given);
            write_file(mesh_file, to_binary_stl(mesh));
        }
        for (const StageCall& call : chain.filters) {
            filters.push_back(bench.registry().make<MeshFilter>(call.stage, call.given));
        }
        if (chain.spherizer) {
            spherizer = bench.registry().make<Spherizer>(chain.spherizer->stage, chain.spherizer->given);
        }
        const double begin = cpu_seconds();
        Mesh current = loader ? loader->load(mesh_file, context) : Mesh();
        const Mesh& original = loader ? current : mesh;
        std::optional<Mesh> filtered;
        for (const auto& filter : filters) {
            filtered = filter->apply(filtered ? *filtered : original, context);
        }
        if (spherizer) {
            const auto solid = Solid::make(original);
            const Shape shape("mesh", filtered ? Solid::make(*filtered) : solid, solid);
            Budget budget;
            budget.max_spheres = spheres;
            finished_tree(*solid, spherizer->spherize(shape, budget, context), Guarantee::outer);
        }
        return cpu_seconds() - begin;
    }

    std::string method_text(const std::string& chosen, const std::vector<SizedMesh>& meshes) const {
        std::string text = fmt::format("The mesh is {}", chosen);
        for (const StageCall& call : prepare) {
            text += fmt::format(", then {}", text_of(call));
        }
        text += fmt::format("; simplify.quadric takes it down to a number of triangles, splitting longest edges takes "
                            "it up. Every stage "
                            "runs in this process, up to {} times; a time is the median, in CPU seconds of the "
                            "process, user and system, "
                            "over all its threads. A case that takes more than {:g} s is the last of its curve.",
                            repeats, time_limit);
        if (std::any_of(groups.begin(), groups.end(), [](const Group& group) {
                return std::any_of(group.curves.begin(), group.curves.end(),
                                   [](const Chain& chain) { return chain.spherizer.has_value(); });
            })) {
            text += fmt::format(" The time of a spherizer goes from the mesh in memory to at most {} spheres that are "
                                "proved to cover it.",
                                spheres);
        }
        text += " Growth is the exponent of the number of triangles n in the law fitted by least squares to the "
                "logarithms, "
                "over the counts from a tenth of the curve's largest on.";
        text += parameters_text();
        const SizedMesh* off = nullptr;
        for (const SizedMesh& m : meshes) {
            off = m.mesh.triangles.size() > m.asked + 1 ? &m : off;
        }
        return off ? text + fmt::format(" The coarsest mesh has {} triangles: its shape needs them.",
                                        meshes.front().mesh.triangles.size())
                   : text;
    }

    /// The stages whose parameters are not all at their defaults.
    std::string parameters_text() const {
        std::set<std::string> texts;
        for (const Group& group : groups) {
            for (const Chain& chain : group.curves) {
                for (const StageCall& call : chain.calls()) {
                    if (!call.given.empty()) {
                        texts.insert(text_of(call));
                    }
                }
            }
        }
        return texts.empty() ? "" : fmt::format(" Parameters that are given: {}.", fmt::join(texts, ", "));
    }

    static void add_cases(const Group& group, const Curve& curve, Table& table) {
        for (const Case& c : curve.cases) {
            table.rows.push_back({group.name, curve.chain->label, std::to_string(c.asked), std::to_string(c.triangles),
                                  c.seconds.empty() ? "" : fmt::format("{:.6f}", c.median()),
                                  std::to_string(c.seconds.size()), c.left_out});
        }
    }

    void add_section(const Group& group, const std::vector<Curve>& curves, Outcome& outcome) const {
        Section section;
        section.title = groups.size() > 1 ? group.name : "";
        section.figure = group.name + ".svg";
        section.table.columns = {"CPU s"};
        for (const std::size_t count : triangles) {
            section.table.columns.push_back(std::to_string(count));
        }
        section.table.columns.emplace_back("growth");
        plot::Plot picture;
        picture.title = title;
        picture.x = {.label = "triangles", .logarithmic = true, .ticks = {}};
        picture.y = {.label = "CPU time, s", .logarithmic = true, .ticks = {}};
        picture.panels.emplace_back();
        for (const Curve& curve : curves) {
            const Points points = curve.points();
            std::vector<std::string> row{curve.chain->label};
            for (const Case& c : curve.cases) {
                row.push_back(c.seconds.empty() ? c.left_out : short_number(c.median()));
            }
            row.push_back(growth_text(points));
            section.table.rows.push_back(std::move(row));
            picture.panels[0].series.push_back({labelled(curve.chain->label, points), points, false});
        }
        for (const Reference& reference : references) {
            const std::filesystem::path found = find_reference(reference, file);
            if (found.empty()) {
                section.text += fmt::format("Left out, its file is not here: {} ({}). ", reference.label,
                                            fmt::join(reference.files, ", "));
                continue;
            }
            const Points points = load_reference(reference, found);
            section.text +=
                fmt::format("{}: {} published times, growth {}. ", reference.label, points.size(), growth_text(points));
            picture.panels[0].series.push_back({labelled(reference.label, points), points, true});
        }
        outcome.figures.push_back({section.figure, std::move(picture)});
        outcome.sections.push_back(std::move(section));
    }

    static std::string labelled(const std::string& label, const Points& points) {
        const auto law = fitted_power_law(points);
        return law ? fmt::format("{}, n^{:.2f}", label, law->exponent) : label;
    }
};

std::vector<Group> read_groups(const Value& value, const Checking& checking) {
    std::vector<Group> groups;
    if (!expect_map(value, "figures", "figures: {repair: [repair.soup]}", checking.findings)) {
        return groups;
    }
    constexpr ChainRule rule{true, true, true, "mesh loaders, mesh filters and spherizers"};
    for (std::size_t i = 0; i < value.keys.size(); ++i) {
        const Key& key = value.keys[i];
        if (const std::string why = why_no_folder_name(key.text); !why.empty()) {
            checking.findings.error(key.where, "bad-name",
                                    fmt::format("{} names the file of a figure, but {}", in_quotes(key.text), why));
        }
        groups.push_back({key.text, read_chains(value.items[i], key.text, rule, checking)});
    }
    if (groups.empty()) {
        checking.findings.error(value.where, "wrong-type", "'figures' expects at least one figure");
    }
    return groups;
}

} // namespace

std::unique_ptr<Experiment> read_time_against_triangles(const Value& root, const Checking& checking) {
    auto experiment = std::make_unique<TimeAgainstTriangles>();
    Findings& findings = checking.findings;
    const auto values = read_kind_values(root,
                                         {Parameter::integer("repeats", 3).bounds(1, 1000),
                                          Parameter::number("time_limit", 10).bounds(0.001, 1e6).unit("s"),
                                          Parameter::integer("spheres", 8).bounds(1, 1e6)},
                                         {"mesh", "prepare", "triangles", "figures", "references"}, checking);
    take(values, "repeats", experiment->repeats);
    take(values, "time_limit", experiment->time_limit);
    take(values, "spheres", experiment->spheres);
    if (const Value* mesh = required(root, "mesh", "mesh: FILE", findings)) {
        experiment->candidates = {read_references(*mesh, "mesh", findings), findings.locate(mesh->where)};
    }
    if (const Value* prepare = root.find("prepare")) {
        if (const auto chain = read_chain(*prepare, "prepare", {false, true, false, "mesh filters"}, checking)) {
            experiment->prepare = chain->filters;
        }
    }
    experiment->triangles = required_counts(root, "triangles", "triangles: [500, 1000, 2000]", 4, 1e7, findings);
    if (const Value* figures = required(root, "figures", "figures: {repair: [repair.soup]}", findings)) {
        experiment->groups = read_groups(*figures, checking);
    }
    if (const Value* references = root.find("references")) {
        experiment->references = read_reference_list(*references, findings);
    }
    return experiment;
}

} // namespace foam::bench::experiment
