#include "session_work.hpp"

#include <foam/base/file.hpp>
#include <foam/base/internal/files.hpp>
#include <foam/base/parallel.hpp>
#include <foam/base/text.hpp>
#include <foam/judge/written_model.hpp>
#include <foam/robot/robot.hpp>
#include <foam/runtime/internal/reading.hpp>
#include <foam/sdk/context.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace foam::inline view {
namespace {

/// Returns the robot with the visual elements behind the collision elements, so that each file is read once.
Robot with_all_elements(Robot robot, bool collisions) {
    for (Link& link : robot.links) {
        if (!collisions) {
            link.collisions.clear();
        }
        link.collisions.insert(link.collisions.end(), link.visuals.begin(), link.visuals.end());
    }
    return robot;
}

/// Colours of the triangles of mesh files, by path.
using FileColours = std::map<std::filesystem::path, std::vector<Colour>>;

FileColours file_colours(const Registry& registry, const Reading& reading, const Robot& robot) {
    std::set<std::filesystem::path> distinct;
    for (const Link& link : robot.links) {
        for (const GeometryElement& element : link.visuals) {
            if (const auto* mesh = std::get_if<MeshReference>(&element.geometry); mesh && !mesh->path.empty()) {
                distinct.insert(mesh->path);
            }
        }
    }
    const std::vector<std::filesystem::path> files(distinct.begin(), distinct.end());
    std::vector<std::vector<Colour>> colours(files.size());
    parallel_for(files.size(), [&](std::size_t i) {
        const RegisteredStage* stage = mesh_loader_of(registry, reading, files[i]);
        if (!stage) {
            return;
        }
        const auto loader = registry.make<MeshLoader>(stage->info.name);
        const auto* coloured = dynamic_cast<const MeshColours*>(loader.get());
        try {
            QuietContext context;
            colours[i] = coloured ? coloured->colours(files[i], context) : std::vector<Colour>{};
        } catch (const Error&) {
            colours[i].clear(); // load_links() reports the file
        }
    });
    FileColours result;
    for (std::size_t i = 0; i < files.size(); ++i) {
        result.emplace(files[i], std::move(colours[i]));
    }
    return result;
}

/// The distinct meshes of a robot: elements of one mesh and one list of colours share it.
class SharedMeshes {
public:
    std::shared_ptr<const ViewedMesh> of(const CollisionElement& element, const FileColours* colours) {
        const auto* reference = std::get_if<MeshReference>(&element.source->geometry);
        const std::vector<Colour>* own = nullptr;
        if (const Element* primitive = element.primitive()) {
            return std::make_shared<const ViewedMesh>(
                ViewedMesh{std::make_shared<const Mesh>(enclosing_mesh(*primitive)), {}});
        }
        if (const auto known = colours && reference ? colours->find(reference->path) : FileColours::const_iterator{};
            colours && reference && known != colours->end() && known->second.size() == element.raw->triangles.size()) {
            own = &known->second;
        }
        auto& shared = meshes_[{element.raw.get(), own}];
        if (!shared) {
            shared = std::make_shared<const ViewedMesh>(ViewedMesh{element.raw, own ? *own : std::vector<Colour>{}});
        }
        return shared;
    }

private:
    std::map<std::pair<const Mesh*, const std::vector<Colour>*>, std::shared_ptr<const ViewedMesh>> meshes_;
};

Reading reading_for(const std::filesystem::path& file, const SubjectOptions& options, bool mesh) {
    return {.resources = ResourceResolver::from_environment().preceded_by(options.package_path),
            .unit = mesh ? options.unit : MeshUnit{},
            .name = file == options.nameless ? options.nameless_name : std::filesystem::path()};
}

/// Returns the colour of a visual's material; nothing where there is none, or only a texture.
std::optional<Colour> colour_of(const GeometryElement& visual) {
    if (!visual.material || !visual.material->rgba) {
        return std::nullopt;
    }
    Colour colour = 0;
    for (const double share : *visual.material->rgba) {
        colour = colour << 8 | static_cast<Colour>(std::lround(255 * std::clamp(share, 0.0, 1.0)));
    }
    return colour;
}

/// Drops visuals whose file was not found; their loader has warned of them.
Robot without_missing_visuals(Robot robot) {
    for (Link& link : robot.links) {
        std::erase_if(link.visuals, [](const GeometryElement& element) {
            const auto* mesh = std::get_if<MeshReference>(&element.geometry);
            return mesh && mesh->path.empty() && !mesh->mesh;
        });
    }
    return robot;
}

/// Moves the joints that are named.
void set_joints(NamedPose& pose, const JointValues& values, const Kinematics& kinematics) {
    for (std::size_t i = 0; i < pose.configuration.size(); ++i) {
        if (const auto value = values.find(kinematics.freedoms()[i].joint); value != values.end()) {
            pose.configuration[i] = value->second;
        }
    }
}

/// Sets of each link whether spheres are judged by it: of those that are chosen. Spheres are not judged by the spheres
/// of a sphere model.
void judge_links(ViewedRobot& robot, const SubjectOptions& options) {
    const bool by_model = is_sphere_model(*robot.robot) && options.geometry != CoveredGeometry::visual;
    const Robot covered = with_covered_geometry(*robot.robot, options.geometry);
    for (std::size_t l = 0; l < robot.links.size(); ++l) {
        const Link& link = covered.links[l];
        robot.links[l].judged = !by_model && !link.collisions.empty() && is_chosen(options.choices, link.name);
        robot.judged |= robot.links[l].judged;
    }
}

} // namespace

bool is_sphere(const GeometryElement& element) {
    const auto* primitive = std::get_if<Element>(&element.geometry);
    return primitive && primitive->kind == Element::Kind::sphere;
}

bool is_sphere_model(const Robot& robot) {
    std::size_t spheres = 0, others = 0;
    for (const Link& link : robot.links) {
        for (const GeometryElement& element : link.collisions) {
            (is_sphere(element) ? spheres : others) += 1;
        }
    }
    return spheres > 0 && others == 0;
}

bool is_mesh_file(const std::filesystem::path& file, const Registry& registry) {
    return registry.find_for_extension(StageKind::mesh_loader, extension_of(file)) != nullptr;
}

ViewedRobot load_robot(const std::filesystem::path& file, const SubjectOptions& options, const Registry& registry,
                       std::vector<std::string>& notes) {
    const bool mesh = is_mesh_file(file, registry);
    const Reading reading = reading_for(file, options, mesh);
    const RunOptions run_options;
    Journal journal(nullptr);
    const Calls calls{registry, run_options, journal};
    auto input = std::make_shared<LoadedInput>(read_input(calls, reading, std::filesystem::absolute(file),
                                                          mesh ? InputKind::mesh : InputKind::robot, file.string()));

    ViewedRobot result;
    result.file = file;
    result.loaded = input;
    const auto robot = std::make_shared<const Robot>(without_missing_visuals(*input->robot));
    result.robot = robot;
    result.kinematics = std::make_shared<const Kinematics>(robot);
    result.poses = named_poses(*result.kinematics, options.srdf, options.choices.locks);
    result.links.resize(robot->links.size());
    const bool spheres = is_sphere_model(*robot);
    judge_links(result, options);

    const Robot all = with_all_elements(*robot, !spheres);
    LoadedLinks loaded = load_links(calls, reading, all, [](const Link&) { return true; }, {});
    input->meshes = std::move(loaded.meshes);
    const FileColours colours = file_colours(registry, reading, *robot);
    SharedMeshes shared;
    for (const LoadedLink& link : loaded.links) {
        const auto l = static_cast<std::size_t>(link.link - all.links.data());
        const std::size_t collisions = spheres ? 0 : robot->links[l].collisions.size();
        if (link.error) {
            notes.push_back(shown(link.error->what()));
        }
        for (std::size_t e = 0; e < link.elements.size(); ++e) {
            const CollisionElement& element = link.elements[e];
            if (!element.raw && !element.primitive()) {
                continue;
            }
            const bool visual = e >= collisions;
            ViewedElement viewed{shared.of(element, visual ? &colours : nullptr), element.source->origin, {}};
            if (visual) {
                viewed.colour = colour_of(*element.source);
            }
            (visual ? result.links[l].visuals : result.links[l].collisions).push_back(std::move(viewed));
        }
    }
    for (const Finding& finding : journal.findings()) {
        if (finding.severity >= Severity::warning) {
            notes.push_back(shown(finding.message));
        }
    }
    return result;
}

ViewedRobot robot_of_names(const SphereFile& file) {
    ViewedRobot result;
    result.robot = links_alone(file);
    result.links.resize(result.robot->links.size());
    return result;
}

std::vector<NamedPose> named_poses(const Kinematics& kinematics, const std::filesystem::path& srdf,
                                   const JointValues& locks) {
    std::vector<NamedPose> poses{{"zero", kinematics.configuration()}, {"middle", {}}};
    for (const Freedom& freedom : kinematics.freedoms()) {
        poses.back().configuration.push_back((freedom.lower + freedom.upper) / 2);
    }
    const std::vector<GroupState> states = srdf.empty()
                                               ? std::vector<GroupState>{}
                                               : group_states(read_file(srdf, most_robot_bytes), srdf.string());
    for (const GroupState& state : states) {
        NamedPose& pose = poses.emplace_back(NamedPose{state.name, kinematics.configuration()});
        set_joints(pose, state.values, kinematics); // joints of another version are left out
    }
    for (NamedPose& pose : poses) {
        set_joints(pose, locks, kinematics);
    }
    return poses;
}

} // namespace foam::inline view
