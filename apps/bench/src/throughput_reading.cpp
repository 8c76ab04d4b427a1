#include "kinds.hpp"
#include "throughput.hpp"

#include <foam/recipe/internal/yaml.hpp>

#include <fmt/format.h>

namespace foam::inline bench::experiment {
namespace {

using namespace reading;

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
    take(values, "mass", object.mass);
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
    take(values, "time", moment.time);
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

const std::vector<Parameter>& throughput_values() {
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
        read_kind_values(root, throughput_values(),
                         {"robot", "method", "spheres", "object", "fingers", "object_ignores", "motion"}, checking);
    take(values, "simulations", experiment->simulations);
    take(values, "repeats", experiment->repeats);
    take(values, "threads", experiment->threads);
    take(values, "timestep", experiment->timestep);
    take(values, "spread", experiment->spread);
    take(values, "lift", experiment->lift);
    if (const Value* robot = required(root, "robot", "robot: FILE.urdf", findings)) {
        experiment->robot = {"robot", read_references(*robot, "robot", findings), findings.locate(robot->where)};
    }
    experiment->spheres = required_counts(root, "spheres", "spheres: [11, 22]", 1, 1e5, findings);
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

} // namespace foam::bench::experiment
