// kind: throughput. Many simulations of a robot that grasps an object, original geometry against spheres, in MuJoCo:
// Table II of Coumar et al., "Foam: A Tool for Spherical Approximation of Robot Geometry" (2025).
#include "throughput.hpp"

#include <foam/base/error.hpp>
#include <foam/collision/self_collision.hpp>
#include <foam/runtime/internal/child.hpp>
#include <foam/runtime/run.hpp>
#include <foam/sdk/sdk.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <thread>

namespace foam::inline bench::experiment {

using nlohmann::json;

namespace {

constexpr const char* program_name = "foam-engine-mujoco-grasp";

std::size_t index_of(const Robot& urdf, const std::string& link) {
    const Link* found = urdf.find_link(link);
    if (!found) {
        throw Error(ErrorCode::input, fmt::format("{}: there is no link '{}'", urdf.file.string(), link));
    }
    return static_cast<std::size_t>(found - urdf.links.data());
}

std::vector<std::size_t> indices(const Robot& urdf, const std::vector<std::string>& names) {
    std::vector<std::size_t> result;
    for (const std::string& link : names) {
        result.push_back(index_of(urdf, link));
    }
    return result;
}

} // namespace

std::set<std::string> Throughput::stages() const {
    std::set<std::string> names;
    if (method) {
        add_names(*method, names);
    }
    return names;
}

Outcome Throughput::run(Bench& bench) const {
    const std::filesystem::path program = library_folder() / "foam/engines" / program_name;
    if (!std::filesystem::exists(program)) {
        throw Error(ErrorCode::plugin, fmt::format("the program {} is not built; remedy: apt-get install "
                                                   "libmujoco-dev, then configure and build foam again",
                                                   program_name));
    }
    std::string input;
    const Original original =
        load_original(resolve_input(recipe_of(*this, robot, nullptr), &input).path, bench.registry());
    const Kinematics kinematics(original.robot);
    std::vector<GraspModel> models = models_of(bench, original);
    const GraspSetup setup{object, excluded_pairs(kinematics, models, bench), indices(*original.robot, object_ignores),
                           indices(*original.robot, fingers), timestep};
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

std::vector<GraspModel> Throughput::models_of(const Bench& bench, const Original& original) const {
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
        Recipe recipe = recipe_of(*this, robot, &*method);
        recipe.budget_spheres = budget;
        const RunResult made = foam::run(recipe, bench.registry(), options);
        GraspModel model = bare;
        for (LinkSpheres& link : spheres_by_link(made.model)) {
            model.spheres += link.elements.spheres().size();
            model.links[index_of(urdf, link.link)].spheres = std::move(link.elements.spheres());
        }
        model.label = fmt::format("{} spheres", model.spheres);
        models.push_back(std::move(model));
    }
    return models;
}

LinkPairs Throughput::excluded_pairs(const Kinematics& kinematics, const std::vector<GraspModel>& models,
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
            balls.elements.push_back(link.spheres);
        }
        for (const LinkPair& pair : self_collision_matrix(kinematics, balls, options).pairs) {
            if (pair.reason != PairReason::none) {
                excluded.emplace(pair.first, pair.second);
            }
        }
    }
    return {excluded.begin(), excluded.end()};
}

json Throughput::request_of(const Kinematics& kinematics, const GraspScene& scene) const {
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

std::size_t Throughput::threads_used() const {
    return threads > 0 ? threads : std::max<std::size_t>(std::thread::hardware_concurrency(), 1);
}

Measurement Throughput::measured(const Bench& bench, const std::filesystem::path& program, const Kinematics& kinematics,
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

Measurement Throughput::measurement_of(const json& answer, const GraspModel& model) const {
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

} // namespace foam::bench::experiment
