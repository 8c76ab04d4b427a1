// kind: throughput. Many simulations of a robot that grasps an object, original geometry against spheres, in MuJoCo:
// Table II of Coumar et al., "Foam: A Tool for Spherical Approximation of Robot Geometry" (2025).
#include "bench.hpp"
#include "chain.hpp"
#include "grasp_scene.hpp"
#include "kinds.hpp"
#include "recipe/extend.hpp"
#include "run/child.hpp"

#include <foam/error.hpp>
#include <foam/host/evaluate.hpp>
#include <foam/host/run.hpp>
#include <foam/host/sdk.hpp>
#include <foam/host/self_collision.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <set>
#include <thread>

namespace foam::experiment {
namespace {

using namespace reading;
using nlohmann::json;

constexpr const char* program_name = "foam-engine-mujoco-grasp";

/// Values of joints at a time; those that are not named stay where they were.
struct Moment {
    double time = 0; ///< s
    JointValues joints;
};

/// The robot with one kind of geometry.
struct GraspModel {
    std::string label;
    std::vector<GraspLink> links;
    std::size_t spheres = 0; ///< 0: the original
    GraspScene scene;
};

/// One run of all simulations of a model.
struct Measurement {
    double steps = 0, wall = 0, cpu = 0; ///< s
    double contacts = 0;                 ///< a step
    std::size_t gripped = 0, lifted = 0; ///< simulations
    double lift = 0;                     ///< m; mean
};

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

class Throughput final : public Experiment {
public:
    std::vector<std::string> robot;
    Location robot_where;
    std::optional<Chain> method;
    std::vector<std::size_t> spheres; ///< budgets over the whole robot
    std::size_t simulations = 300, repeats = 5, threads = 0;
    double timestep = 0.004, spread = 0.003, lift = 0.05;
    GraspObject object;
    std::vector<std::string> fingers, object_ignores;
    std::vector<Moment> motion;

    std::set<std::string> stages() const override {
        std::set<std::string> names;
        if (method) {
            add_names(*method, names);
        }
        return names;
    }

    Outcome run(Bench& bench) const override {
        const std::filesystem::path program = library_folder() / "foam/engines" / program_name;
        if (!std::filesystem::exists(program)) {
            throw Error(ErrorCode::plugin, fmt::format("the program {} is not built; remedy: apt-get install "
                                                       "libmujoco-dev, then configure and build foam again",
                                                       program_name));
        }
        std::string input;
        const Original original = load_original(resolve_input(recipe_of({}), &input).path, bench.registry());
        const Kinematics kinematics(original.robot);
        std::vector<GraspModel> models = models_of(bench, original);
        const GraspSetup setup{object, excluded_pairs(kinematics, models, bench),
                               indices(*original.robot, object_ignores), indices(*original.robot, fingers), timestep};
        for (GraspModel& model : models) {
            model.scene = grasp_scene(kinematics, model.links, setup);
        }
        std::vector<std::vector<Measurement>> results(models.size());
        std::string version;
        for (std::size_t repeat = 0; repeat < repeats; ++repeat) {
            for (std::size_t m = 0; m < models.size(); ++m) {
                results[m].push_back(measured(bench, program, kinematics, models[m], version));
                const Measurement& last = results[m].back();
                bench.tell(fmt::format("{}: {}, {} of {}: {:.0f} steps a second, {:.0f} a CPU second; {} of {} lifted",
                                       name, models[m].label, repeat + 1, repeats, last.steps / last.wall,
                                       last.steps / last.cpu, last.lifted, simulations));
            }
        }
        return told(models, results, version, input, setup.excluded.size());
    }

private:
    Recipe recipe_of(std::optional<std::size_t> budget) const {
        Recipe recipe;
        recipe.file = file;
        recipe.name = name;
        recipe.urdf = robot;
        recipe.input_where = robot_where;
        if (method) {
            recipe.filters = method->filters;
            recipe.spherizer = *method->spherizer;
        }
        recipe.budget_spheres = budget;
        return recipe;
    }

    std::vector<GraspModel> models_of(const Bench& bench, const Original& original) const {
        const Robot& urdf = *original.robot;
        GraspModel bare{.label = "original", .links = std::vector<GraspLink>(urdf.links.size()), .scene = {}};
        for (const OriginalLink& link : original.links) {
            bare.links[index_of(urdf, link.link)].solid = link.solid;
        }
        std::vector<GraspModel> models{bare};
        for (const std::size_t budget : spheres) {
            RunOptions options;
            options.fresh = true;
            options.cancel = bench.cancel();
            const RunResult made = foam::run(recipe_of(budget), bench.registry(), options);
            GraspModel model = bare;
            for (LinkSpheres& link : spheres_by_link(made.model)) {
                model.spheres += link.spheres.size();
                model.links[index_of(urdf, link.link)].spheres = std::move(link.spheres);
            }
            model.label = fmt::format("{} spheres", model.spheres);
            models.push_back(std::move(model));
        }
        return models;
    }

    /// The pairs that the self-collision matrix of any of the sphere models leaves out: the same for all models.
    LinkPairs excluded_pairs(const Kinematics& kinematics, const std::vector<GraspModel>& models,
                             const Bench& bench) const {
        std::set<std::pair<std::size_t, std::size_t>> excluded;
        SelfCollisionOptions options;
        options.samples = 10000;
        options.proof_boxes = 2000;
        options.reference = motion.front().joints;
        options.cancel = bench.cancel();
        for (const GraspModel& model : models) {
            if (model.spheres == 0) {
                continue;
            }
            CollisionModel balls{
                std::shared_ptr<const Robot>(std::shared_ptr<const Robot>(), &kinematics.robot()), {}, {}, {}};
            for (const GraspLink& link : model.links) {
                balls.spheres.push_back(link.spheres);
            }
            for (const LinkPair& pair : self_collision_matrix(kinematics, balls, options).pairs) {
                if (pair.reason != PairReason::none) {
                    excluded.emplace(pair.first, pair.second);
                }
            }
        }
        return {excluded.begin(), excluded.end()};
    }

    static std::size_t index_of(const Robot& urdf, const std::string& link) {
        const Link* found = urdf.find_link(link);
        if (!found) {
            throw Error(ErrorCode::input, fmt::format("{}: there is no link '{}'", urdf.file.string(), link));
        }
        return static_cast<std::size_t>(found - urdf.links.data());
    }

    static std::vector<std::size_t> indices(const Robot& urdf, const std::vector<std::string>& names) {
        std::vector<std::size_t> result;
        for (const std::string& link : names) {
            result.push_back(index_of(urdf, link));
        }
        return result;
    }

    /// What the program is asked.
    json request_of(const Kinematics& kinematics, const GraspScene& scene) const {
        JointValues values;
        json moments = json::array();
        for (const Moment& moment : motion) {
            for (const auto& [joint, value] : moment.joints) {
                values[joint] = value;
            }
            const std::vector<double> joints = kinematics.joint_values(kinematics.configuration(values));
            std::vector<double> controls;
            for (const std::size_t joint : scene.joints) {
                controls.push_back(joints[joint]);
            }
            moments.push_back({{"time", moment.time}, {"controls", controls}});
        }
        std::vector<double> start = moments.front()["controls"];
        start.insert(start.end(), {scene.object.x, scene.object.y, scene.object.z, 1, 0, 0, 0});
        json offsets = json::array();
        Random random(derive_seed(0, "offsets of the object"));
        for (std::size_t i = 0; i < simulations; ++i) {
            const double x = random.uniform(-spread, spread), y = random.uniform(-spread, spread);
            offsets.push_back({x, y});
        }
        return {{"scene", scene.text},
                {"object", "object"},
                {"fingers", fingers},
                {"motion", moments},
                {"steps", static_cast<int>(std::lround(motion.back().time / timestep))},
                {"start", start},
                {"offsets", offsets},
                {"threads", threads_used()}};
    }

    std::size_t threads_used() const {
        return threads > 0 ? threads : std::max<std::size_t>(std::thread::hardware_concurrency(), 1);
    }

    Measurement measured(const Bench& bench, const std::filesystem::path& program, const Kinematics& kinematics,
                         const GraspModel& model, std::string& version) const {
        json answer;
        ChildLimits limits;
        limits.cancelled = [&bench] { return bench.cancelled(); };
        const ChildEnd end =
            run_child(program, request_of(kinematics, model.scene).dump(), limits, [&](std::string_view message) {
                answer = json::parse(message);
                return true;
            });
        bench.check_cancelled();
        if (end.why != ChildEnd::Why::answered) {
            throw Error(ErrorCode::internal,
                        fmt::format("{} ended without an answer on the model '{}'", program_name, model.label));
        }
        if (answer.contains("error")) {
            throw Error(ErrorCode::input,
                        fmt::format("the model '{}': {}", model.label, answer["error"].get<std::string>()));
        }
        version = answer["version"];
        return measurement_of(answer, model);
    }

    Measurement measurement_of(const json& answer, const GraspModel& model) const {
        Measurement result{.steps = answer["steps"], .wall = answer["wall_s"], .cpu = answer["cpu_s"]};
        int warnings = 0;
        for (const json& simulation : answer["simulations"]) {
            result.contacts += simulation["contacts"].get<double>() / result.steps;
            result.gripped += simulation["both_fingers"].get<bool>() ? 1 : 0;
            result.lifted += simulation["lift_m"].get<double>() >= lift ? 1 : 0;
            result.lift += simulation["lift_m"].get<double>() / static_cast<double>(simulations);
            warnings += simulation["warnings"].get<int>();
        }
        if (warnings > 0) {
            throw Error(ErrorCode::input,
                        fmt::format("the model '{}': MuJoCo warns {} times of a simulation that is not valid: too many "
                                    "contacts, or one that goes to pieces",
                                    model.label, warnings));
        }
        return result;
    }

    Outcome told(const std::vector<GraspModel>& models, const std::vector<std::vector<Measurement>>& results,
                 const std::string& version, const std::string& input, std::size_t excluded) const {
        Outcome outcome;
        outcome.cases = {{"model", "spheres", "repeat", "steps", "wall_s", "cpu_s", "steps_per_s", "steps_per_cpu_s",
                          "contacts_per_step", "gripped", "lifted", "mean_lift_m"},
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
                                  fmt::format("{:.1f}", last.contacts),
                                  fmt::format("{} of {}", last.gripped, simulations),
                                  fmt::format("{} of {}", last.lifted, simulations)});
        }
        outcome.sections.push_back({"", text_of(version, input, excluded), "", {}});
        outcome.sections.push_back({"", "", "", std::move(table)});
        return outcome;
    }

    static std::string change(const Mean& mean, const Mean& first) {
        return fmt::format("{:+.0f} %", 100 * (mean.value / first.value - 1));
    }

    std::string text_of(const std::string& version, const std::string& input, std::size_t excluded) const {
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
};

/// A list of three numbers.
std::optional<Vec3> read_vector(const Value& value, const char* key, double low, Findings& findings) {
    const std::string example = fmt::format("{}: [0.1, 0.1, 0.1]", key);
    if (!expect_list(value, key, example, findings)) {
        return {};
    }
    if (value.items.size() != 3) {
        findings.error(
            value.where, "wrong-type",
            fmt::format("'{}' expects three numbers, got {}; remedy: write {}", key, value.items.size(), example));
        return {};
    }
    Vec3 result;
    for (int axis = 0; axis < 3; ++axis) {
        const auto number = read_value(value.items[static_cast<std::size_t>(axis)],
                                       Parameter::number(key, 0.1).bounds(low, 100).unit("m"), "", findings);
        result[axis] = number ? std::get<double>(*number) : 0;
    }
    return result;
}

void read_object(const Value& value, GraspObject& object, Findings& findings) {
    if (!expect_map(value, "object", "object: {size: [0.03, 0.03, 0.1], position: [0.5, 0, 0], mass: 0.1}", findings)) {
        return;
    }
    const auto values = read_values(value, {Parameter::number("mass", 0.1).bounds(1e-6, 1e3).unit("kg")}, "object",
                                    {"size", "position"}, findings);
    if (const auto mass = values.find("mass"); mass != values.end()) {
        object.mass = std::get<double>(mass->second);
    }
    if (const Value* size = value.find("size")) {
        object.size = read_vector(*size, "size", 1e-4, findings).value_or(object.size);
    }
    if (const Value* position = value.find("position")) {
        object.position = read_vector(*position, "position", -100, findings).value_or(object.position);
    }
}

std::optional<Moment> read_moment(const Value& value, Findings& findings) {
    constexpr const char* example = "{time: 1, joints: {elbow: 0.5}}";
    if (!expect_map(value, "motion", example, findings)) {
        return {};
    }
    const auto values =
        read_values(value, {Parameter::number("time", 0).bounds(0, 1e4).unit("s")}, "motion", {"joints"}, findings);
    Moment moment;
    if (const auto time = values.find("time"); time != values.end()) {
        moment.time = std::get<double>(time->second);
    }
    const Value* joints = value.find("joints");
    if (joints && expect_map(*joints, "joints", "joints: {elbow: 0.5}", findings)) {
        for (std::size_t i = 0; i < joints->keys.size(); ++i) {
            const auto number = read_value(
                joints->items[i], Parameter::number(joints->keys[i].text, 0).bounds(-1e3, 1e3), "joints", findings);
            moment.joints[joints->keys[i].text] = number ? std::get<double>(*number) : 0;
        }
    }
    return moment;
}

std::vector<Moment> read_motion(const Value& value, Findings& findings) {
    std::vector<Moment> motion;
    if (!expect_list(value, "motion", "motion: [{time: 0, joints: {elbow: 0}}, {time: 1, joints: {elbow: 1}}]",
                     findings)) {
        return motion;
    }
    for (const Value& item : value.items) {
        const auto moment = read_moment(item, findings);
        if (!moment) {
            continue;
        }
        if (!motion.empty() && moment->time <= motion.back().time) {
            findings.error(
                item.where, "out-of-order",
                fmt::format("'motion' expects ascending times, got {:g} after {:g}", moment->time, motion.back().time));
        }
        motion.push_back(*moment);
    }
    if (value.items.size() < 2) {
        findings.error(value.where, "wrong-type", "'motion' expects at least two moments");
    }
    return motion;
}

const std::vector<Parameter>& plain_values() {
    static const std::vector<Parameter> values{
        Parameter::integer("simulations", 300).bounds(1, 1e5),
        Parameter::integer("repeats", 5).bounds(1, 1e4),
        Parameter::integer("threads", 0).bounds(0, 1024),
        Parameter::number("timestep", 0.004).bounds(1e-5, 0.1).unit("s"),
        Parameter::number("spread", 0.003).bounds(0, 1).unit("m"),
        Parameter::number("lift", 0.05).bounds(0, 10).unit("m"),
    };
    return values;
}

} // namespace

std::unique_ptr<Experiment> read_throughput(const Value& root, const Checking& checking) {
    auto experiment = std::make_unique<Throughput>();
    Findings& findings = checking.findings;
    const auto values =
        read_kind_values(root, plain_values(),
                         {"robot", "method", "spheres", "object", "fingers", "object_ignores", "motion"}, checking);
    take(values, "simulations", experiment->simulations);
    take(values, "repeats", experiment->repeats);
    take(values, "threads", experiment->threads);
    take(values, "timestep", experiment->timestep);
    take(values, "spread", experiment->spread);
    take(values, "lift", experiment->lift);
    if (const Value* robot = required(root, "robot", "robot: FILE.urdf", findings)) {
        experiment->robot = read_references(*robot, "robot", findings);
        experiment->robot_where = findings.locate(robot->where);
    }
    if (const Value* spheres = required(root, "spheres", "spheres: [11, 22]", findings)) {
        experiment->spheres = read_counts(*spheres, "spheres", 1, 1e5, findings);
    }
    if (const Value* method = required(root, "method", "method: spherize.medial", findings)) {
        experiment->method = read_method(*method, checking);
    }
    if (const Value* object = root.find("object")) {
        read_object(*object, experiment->object, findings);
    }
    if (const Value* fingers = required(root, "fingers", "fingers: [left, right]", findings)) {
        experiment->fingers = read_texts(*fingers, "fingers", findings);
    }
    if (const Value* ignores = root.find("object_ignores")) {
        experiment->object_ignores = read_texts(*ignores, "object_ignores", findings);
    }
    if (const Value* motion = required(
            root, "motion", "motion: [{time: 0, joints: {elbow: 0}}, {time: 1, joints: {elbow: 1}}]", findings)) {
        experiment->motion = read_motion(*motion, findings);
    }
    return experiment;
}

} // namespace foam::experiment
