#include <foam/view/scene.hpp>

#include "drawn_mesh.hpp"
#include "session_work.hpp"

#include <foam/base/parallel.hpp>
#include <foam/base/text.hpp>
#include <foam/report/internal/report.hpp>
#include <foam/runtime/version.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <bit>
#include <cstring>
#include <map>

namespace foam::inline view {
namespace {

static_assert(std::endian::native == std::endian::little, "arrays are written as they lie in memory");

using Json = nlohmann::ordered_json;

/// The arrays behind the JSON.
class Arrays {
public:
    template <class T> Json add(const std::vector<T>& values) {
        bytes_.resize((bytes_.size() + 7) / 8 * 8);
        const std::size_t at = bytes_.size();
        bytes_.resize(at + values.size() * sizeof(T));
        if (!values.empty()) {
            std::memcpy(bytes_.data() + at, values.data(), values.size() * sizeof(T));
        }
        return {{"at", at}, {"count", values.size()}};
    }
    const std::string& bytes() const { return bytes_; }

private:
    std::string bytes_;
};

Json to_json(const Vec3& v) {
    return Json::array({v.x, v.y, v.z});
}

Json to_json(const std::optional<Colour>& colour) {
    return colour ? Json(fmt::format("#{:08x}", *colour)) : Json();
}

const char* name_of(Joint::Kind kind) {
    static constexpr std::array names{"fixed", "revolute", "continuous", "prismatic", "planar", "floating"};
    return names[static_cast<std::size_t>(kind)];
}

/// How many triangles of visuals, or of collision elements, the first picture has at most: about what software draws in
/// a few hundredths of a second.
constexpr std::size_t most_at_first = 30'000;
constexpr double worth_it = 0.7; ///< a coarse mesh with more of the triangles than this is not made

/// The distinct meshes of the subject, in the order of their first use.
class Meshes {
public:
    explicit Meshes(const Subject& subject) {
        for (const ViewedRobot& robot : subject.robots) {
            for (const auto kind : {&ViewedLink::visuals, &ViewedLink::collisions}) {
                double area = 0;
                std::size_t triangles = 0;
                for (const ViewedLink& link : robot.links) {
                    for (const ViewedElement& element : link.*kind) {
                        const std::size_t at = index_.try_emplace(element.mesh.get(), meshes_.size()).first->second;
                        if (at == meshes_.size()) {
                            meshes_.push_back(element.mesh.get());
                            areas_.push_back(surface_area(*element.mesh->mesh));
                        }
                        area += areas_[at];
                        triangles += element.mesh->mesh->triangles.size();
                    }
                }
                if (triangles > most_at_first) {
                    cell_ = std::max(cell_, cell_for(area, most_at_first));
                }
            }
        }
    }

    std::size_t index_of(const ViewedElement& element) const { return index_.at(element.mesh.get()); }

    /// Returns the meshes of the first picture.
    Json first(Arrays& arrays) const {
        return to_json(arrays, [&](std::size_t i) {
            const std::optional<ViewedMesh> coarse = coarse_of(i);
            return std::optional(drawn(coarse ? *coarse : *meshes_[i]));
        });
    }

    /// Returns the meshes of which the first picture has coarse ones; null instead of others.
    Json fine(Arrays& arrays) const {
        return to_json(arrays,
                       [&](std::size_t i) { return coarse_of(i) ? std::optional(drawn(*meshes_[i])) : std::nullopt; });
    }

private:
    std::optional<ViewedMesh> coarse_of(std::size_t i) const {
        if (!(cell_ > 0)) {
            return std::nullopt;
        }
        ViewedMesh coarse = coarsened(*meshes_[i], cell_);
        const auto most = worth_it * static_cast<double>(meshes_[i]->mesh->triangles.size());
        return static_cast<double>(coarse.mesh->triangles.size()) <= most ? std::optional(std::move(coarse))
                                                                          : std::nullopt;
    }

    template <class DrawnOf> Json to_json(Arrays& arrays, const DrawnOf& drawn_of) const {
        std::vector<std::optional<DrawnMesh>> all(meshes_.size());
        parallel_for(meshes_.size(), [&](std::size_t i) { all[i] = drawn_of(i); });
        Json list = Json::array();
        for (std::size_t i = 0; i < all.size(); ++i) {
            if (!all[i]) {
                list.push_back(nullptr);
                continue;
            }
            const Box box = bounds(*meshes_[i]->mesh);
            Json ranges = Json::array();
            for (const ColourRange& range : all[i]->ranges) {
                ranges.push_back({range.first, range.count, view::to_json(range.colour)});
            }
            list.push_back({{"box", {view::to_json(box.low), view::to_json(box.high)}},
                            {"low", view::to_json(all[i]->low)},
                            {"step", all[i]->step},
                            {"vertices", arrays.add(all[i]->vertices)},
                            {"corners", arrays.add(all[i]->corners)},
                            {"ranges", std::move(ranges)}});
        }
        return list;
    }

    std::vector<const ViewedMesh*> meshes_;
    std::vector<double> areas_;
    std::map<const ViewedMesh*, std::size_t> index_;
    double cell_ = 0; ///< of coarse meshes, m; 0: there are none
};

Json elements_json(const std::vector<ViewedElement>& elements, const Meshes& meshes) {
    Json list = Json::array();
    for (const ViewedElement& element : elements) {
        list.push_back(
            {{"mesh", meshes.index_of(element)}, {"pose", rows_of(element.pose)}, {"colour", to_json(element.colour)}});
    }
    return list;
}

Json joints_json(const Kinematics& kinematics) {
    const Robot& robot = kinematics.robot();
    Json list = Json::array();
    for (std::size_t j = 0; j < robot.joints.size(); ++j) {
        const Joint& joint = robot.joints[j];
        const JointMotion& motion = kinematics.motions()[j];
        list.push_back({{"name", shown(joint.name)},
                        {"kind", name_of(joint.kind)},
                        {"parent", kinematics.link_above()[j]},
                        {"child", link_index(robot, joint.child)},
                        {"origin", rows_of(joint.origin)},
                        {"axis", to_json(joint.axis)},
                        {"freedom", motion.freedom ? Json(*motion.freedom) : Json()},
                        {"multiplier", motion.multiplier},
                        {"offset", motion.offset}});
    }
    return list;
}

Json freedoms_json(const Kinematics& kinematics) {
    Json list = Json::array();
    for (const Freedom& freedom : kinematics.freedoms()) {
        const auto& joints = kinematics.robot().joints;
        const auto joint =
            std::find_if(joints.begin(), joints.end(), [&](const Joint& j) { return j.name == freedom.joint; });
        list.push_back({{"joint", shown(freedom.joint)},
                        {"lower", freedom.lower},
                        {"upper", freedom.upper},
                        {"turns", joint->kind != Joint::Kind::prismatic}});
    }
    return list;
}

Json robot_json(const ViewedRobot& robot, const Meshes& meshes) {
    Json links = Json::array(), poses = Json::array();
    for (std::size_t l = 0; l < robot.links.size(); ++l) {
        links.push_back({{"name", shown(robot.robot->links[l].name)},
                         {"visuals", elements_json(robot.links[l].visuals, meshes)},
                         {"collisions", elements_json(robot.links[l].collisions, meshes)}});
    }
    for (const NamedPose& pose : robot.poses) {
        poses.push_back({{"name", shown(pose.name)}, {"values", pose.configuration}});
    }
    Json json{{"name", shown(robot.robot->name)}, {"file", shown(robot.file.filename().string())},
              {"judged", robot.judged},           {"links", std::move(links)},
              {"poses", std::move(poses)},        {"joints", Json::array()},
              {"freedoms", Json::array()}};
    if (robot.kinematics) {
        json["joints"] = joints_json(*robot.kinematics);
        json["freedoms"] = freedoms_json(*robot.kinematics);
    }
    return json;
}

Json step_json(const ModelStep& step, Arrays& arrays) {
    std::vector<double> rows, protrusions;
    std::vector<std::uint32_t> starts{0};
    for (std::size_t l = 0; l < step.spheres.size(); ++l) {
        for (const Sphere& s : step.spheres[l]) {
            rows.insert(rows.end(), {s.center.x, s.center.y, s.center.z, s.radius});
        }
        starts.push_back(static_cast<std::uint32_t>(rows.size() / 4));
        if (step.figures) {
            const std::vector<double>& of_link = step.figures->protrusions.at(l);
            protrusions.insert(protrusions.end(), of_link.begin(), of_link.end());
        }
    }
    Json verdicts;
    for (const std::optional<LinkVerdict>& verdict : step.verdicts.value_or(LinkVerdicts{})) {
        verdicts.push_back(verdict ? json_of<Json>(*verdict) : Json());
    }
    return {
        {"count", rows.size() / 4},
        {"verdicts", std::move(verdicts)},
        {"elements", Json::array({{{"kind", "sphere"}, {"starts", arrays.add(starts)}, {"rows", arrays.add(rows)}}})},
        {"protrusions", step.figures ? arrays.add(protrusions) : Json()}};
}

Json model_json(const SceneModel& model, Arrays& arrays) {
    Json steps = Json::array(), json{{"name", shown(model.name)},
                                     {"format", shown(model.format)},
                                     {"robot", model.robot},
                                     {"at", model.at},
                                     {"ignored", Json()}};
    for (const ModelStep& step : model.steps) {
        steps.push_back(step_json(step, arrays));
    }
    json["steps"] = std::move(steps);
    if (model.ignored) {
        json["ignored"] = *model.ignored;
    }
    return json;
}

std::string framed(const Json& json, const Arrays& arrays) {
    const std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
    std::string bytes = "foamview";
    const auto length = static_cast<std::uint32_t>(text.size());
    bytes.append(reinterpret_cast<const char*>(&length), sizeof length);
    bytes += text;
    bytes.resize((bytes.size() + 7) / 8 * 8);
    return bytes + arrays.bytes();
}

} // namespace

std::string scene_bytes(const Subject& subject, const std::vector<SceneModel>& models,
                        const std::string& session_json) {
    Arrays arrays;
    const Meshes meshes(subject);
    Json json{{"foam", version()}, {"session", Json::parse(session_json)}, {"notes", Json::array()}};
    for (const std::string& note : subject.notes) {
        json["notes"].push_back(shown(note));
    }
    json["robots"] = Json::array();
    for (const ViewedRobot& robot : subject.robots) {
        json["robots"].push_back(robot_json(robot, meshes));
    }
    json["models"] = Json::array();
    for (const SceneModel& model : models) {
        json["models"].push_back(model_json(model, arrays));
    }
    json["meshes"] = meshes.first(arrays);
    return framed(json, arrays);
}

std::string fine_mesh_bytes(const Subject& subject) {
    Arrays arrays;
    Json json{{"meshes", Meshes(subject).fine(arrays)}};
    return framed(json, arrays);
}

} // namespace foam::inline view
