// kind: fidelity. A robot as it looks, as it collides, and as more and more spheres, side by side in one picture.
#include "bench.hpp"
#include "kinds.hpp"

#include <foam/base/error.hpp>
#include <foam/recipe/internal/yaml.hpp>
#include <foam/runtime/internal/input.hpp>
#include <foam/runtime/internal/output.hpp>

#include <fmt/format.h>

namespace foam::inline bench::experiment {
namespace {

using namespace reading;

constexpr const char* picture = "fidelity.png";

class Fidelity final : public Experiment {
public:
    Recipe recipe; ///< for all counts; its pose, size and renderer are those of the picture
    std::optional<Chain> method;
    std::vector<std::size_t> spheres; ///< over the whole robot

    std::set<std::string> stages() const override {
        std::set<std::string> names{recipe.renderer.stage};
        add_names(*method, names);
        return names;
    }

    Outcome run(Bench& bench) const override {
        Recipe each = recipe;
        each.file = file;
        each.name = name;
        each.snapshots = false;
        RunOptions options;
        options.cancel = bench.cancel();
        Journal journal(nullptr);
        const Cache no_cache{{}};
        const Workspace workspace{each, bench.registry(), options, journal, no_cache};
        const Input input = load_input(workspace);
        const auto poses = link_poses(*input.robot, recipe.pose);

        Figure figure;
        figure.title = title;
        figure.width = recipe.snapshot_size[0];
        figure.height = recipe.snapshot_size[1];
        figure.panels.push_back({"visual geometry", meshes_of(workspace, visual(*input.robot), poses), {}});
        figure.panels.push_back({"collision geometry", meshes_of(workspace, *input.robot, poses), {}});
        Table table{
            {"spheres", "made", "excess", "excess error", "mean protrusion, mm", "largest protrusion, mm", "certified"},
            {}};
        for (const std::size_t count : spheres) {
            each.budget_spheres = count;
            const RunResult made = foam::run(each, bench.registry(), options);
            figure.panels.push_back(panel_of(made.model, poses));
            const Measures& m = made.total;
            table.rows.push_back({std::to_string(count), std::to_string(m.spheres), fmt::format("{:.4f}", m.excess),
                                  fmt::format("{:.4f}", m.excess_error), fmt::format("{:.3f}", 1e3 * m.protrusion_mean),
                                  fmt::format("{:.3f}", 1e3 * m.protrusion_max), made.certified ? "yes" : "no"});
            bench.tell(fmt::format("{}: {} spheres, excess {}", name, m.spheres, short_number(m.excess)));
        }
        const auto renderer = bench.registry().make<Renderer>(recipe.renderer.stage, recipe.renderer.given);
        LimitedContext context(bench, std::numeric_limits<double>::infinity());
        return told(input.chosen, std::move(table), renderer->render(figure, context));
    }

private:
    /// The robot whose collision geometry is what it looks like.
    static Robot visual(const Robot& robot) {
        Robot result = robot;
        for (Link& link : result.links) {
            link.collisions.clear();
            for (const GeometryElement& element : link.visuals) {
                const auto* mesh = std::get_if<MeshReference>(&element.geometry);
                if (!mesh || !mesh->path.empty()) { // what is not found was warned of
                    link.collisions.push_back(element);
                }
            }
        }
        return result;
    }

    static std::vector<FigureMesh> meshes_of(const Workspace& workspace, const Robot& robot,
                                             const std::map<std::string, Pose>& poses) {
        std::vector<FigureMesh> result;
        std::vector<InputFile> files;
        for (const LinkWork& link : load_links(workspace, robot, files)) {
            if (link.error) {
                throw Error(*link.error);
            }
            result.push_back({std::make_shared<const Mesh>(link_mesh(link, 0)), poses.at(link.link->name), false});
        }
        return result;
    }

    static Panel panel_of(const SphereModel& model, const std::map<std::string, Pose>& poses) {
        Panel panel;
        for (const LinkSpheres& link : spheres_by_link(model)) {
            for (const Sphere& sphere : link.elements.spheres()) {
                panel.spheres.push_back({poses.at(link.link) * sphere.center, sphere.radius});
            }
        }
        panel.caption = fmt::format("{} spheres", panel.spheres.size());
        return panel;
    }

    Outcome told(const std::string& input, Table table, Image image) const {
        Outcome outcome;
        outcome.pictures.push_back({picture, std::move(image.png)});
        const std::string text =
            fmt::format("{}, spheres by {}; the colour is the radius. Excess is the volume of the spheres outside the "
                        "robot in units "
                        "of the robot's; protrusion is the distance of the spheres' exposed surface from the robot.",
                        input, method->label);
        outcome.sections.push_back({"", text, picture, table});
        outcome.cases = std::move(table);
        return outcome;
    }
};

} // namespace

std::unique_ptr<Experiment> read_fidelity(const Value& root, const Checking& checking) {
    auto experiment = std::make_unique<Fidelity>();
    Recipe& recipe = experiment->recipe;
    Findings& findings = checking.findings;
    read_kind_values(root, {}, {"robot", "method", "spheres", "snapshots"}, checking);
    if (const Value* robot = required(root, "robot", "robot: FILE.urdf", findings)) {
        recipe.urdf = read_references(*robot, "robot", findings);
        recipe.input_where = findings.locate(robot->where);
    }
    if (const Value* method = required(root, "method", "method: spherize.medial", findings)) {
        experiment->method = read_method(*method, checking);
        if (experiment->method && experiment->method->spherizer) {
            recipe.filters = experiment->method->filters;
            recipe.spherizer = *experiment->method->spherizer;
        }
    }
    experiment->spheres = required_counts(root, "spheres", "spheres: [11, 22]", 1, 1e5, findings);
    if (const Value* snapshots = required(root, "snapshots", "snapshots: {size: [2520, 720]}", findings)) {
        if (expect_map(*snapshots, "snapshots", "snapshots: {size: [2520, 720]}", findings)) {
            check_snapshots(snapshots, root, recipe, checking);
        }
    }
    return experiment;
}

} // namespace foam::bench::experiment
