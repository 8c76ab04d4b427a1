#include "model.hpp"

#include "document.hpp"
#include "joints.hpp"
#include "shapes.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/base/text.hpp>

#include <sdf/Link.hh>
#include <sdf/Model.hh>
#include <sdf/World.hh>

#include <fmt/format.h>

#include <map>
#include <set>

namespace foam::load_sdf {
namespace {

constexpr const char* world_name = "world"; // SDF keeps the name for it

/// Returns what <inertial> states; nothing without one, where libsdformat takes 1 kg.
std::optional<Inertial> inertial_of(const ::sdf::Link& link, const Document& document) {
    if (!link.Element()->HasElement("inertial")) {
        return {};
    }
    const auto& stated = link.Inertial();
    const auto &own = stated.MassMatrix().DiagonalMoments(), &mixed = stated.MassMatrix().OffDiagonalMoments();
    return Inertial{.mass = stated.MassMatrix().Mass(),
                    .moments = std::array{own.X(), own.Y(), own.Z(), mixed.X(), mixed.Y(), mixed.Z()},
                    .origin = pose_of(stated.Pose()),
                    .line = document.own_line(link.Element()->GetElement("inertial"))};
}

/// Collects links and joints of models, and joins them to one tree.
class Walk {
public:
    Walk(const Document& document, Shapes& shapes, Context& context)
        : document_(document), shapes_(shapes), context_(context) {}

    Robot run() {
        const ::sdf::Root& root = document_.root();
        if (root.WorldCount() > 0) {
            const ::sdf::World& world = *root.WorldByIndex(0);
            robot_.name = world.ModelCount() == 1 ? world.ModelByIndex(0)->Name() : world.Name();
            for (std::uint64_t i = 0; i < world.ModelCount(); ++i) {
                add_top_model(*world.ModelByIndex(i));
            }
        } else if (const ::sdf::Model* model = root.Model()) {
            robot_.name = model->Name();
            add_top_model(*model);
        }
        if (robot_.links.empty()) {
            document_.fail(root.Element(), "there is no model with a link; remedy: a <link> in a <model>");
        }
        for (const auto& [joint, prefix] : joints_) {
            add_joint(*joint, prefix);
        }
        add_root();
        report();
        return std::move(robot_);
    }

private:
    struct Placed {
        Pose pose;              ///< in the world
        bool is_static = false; ///< its model never moves
        std::string above{};    ///< the link above it; empty: none yet
    };

    void add_top_model(const ::sdf::Model& model) {
        add_model(model, document_.scoped() ? model.Name() + "::" : "", {}, false);
    }

    void add_model(const ::sdf::Model& model, const std::string& prefix, const Pose& outer, bool is_static) {
        ignition::math::Pose3d own;
        document_.require_none(model.SemanticPose().Resolve(own));
        const Pose pose = outer * pose_of(own);
        is_static = is_static || model.Static();
        CancellationCounter asking(64);
        for (std::uint64_t i = 0; i < model.LinkCount(); ++i) {
            asking.check();
            add_link(*model.LinkByIndex(i), prefix, pose, is_static);
        }
        for (std::uint64_t i = 0; i < model.ModelCount(); ++i) {
            const ::sdf::Model& inner = *model.ModelByIndex(i);
            add_model(inner, prefix + inner.Name() + "::", pose, is_static);
        }
        for (std::uint64_t i = 0; i < model.JointCount(); ++i) {
            joints_.emplace_back(model.JointByIndex(i), prefix);
        }
    }

    void add_link(const ::sdf::Link& source, const std::string& prefix, const Pose& model, bool is_static) {
        Link link{.name = prefix + source.Name(), .collisions = {}, .visuals = {}};
        ignition::math::Pose3d pose;
        document_.require_none(source.SemanticPose().Resolve(pose, "__model__"));
        links_[link.name] = {.pose = model * pose_of(pose), .is_static = is_static};
        link.inertial = inertial_of(source, document_);
        shapes_.add(link, source);
        robot_.links.push_back(std::move(link));
    }

    void add_joint(const ::sdf::Joint& source, const std::string& prefix) {
        std::string parent, child;
        document_.require_none(source.ResolveParentLink(parent));
        document_.require_none(source.ResolveChildLink(child));
        const std::string above = parent == world_name ? world_name : prefix + parent, below = prefix + child;
        const std::string name = prefix + source.Name();
        if (source.Type() == ::sdf::JointType::GEARBOX) {
            gears_.push_back(name);
            return;
        }
        if (!links_.at(below).above.empty() || is_above(below, above)) {
            loops_.push_back(name);
            return;
        }
        const Motion motion = motion_of(source, child, document_);
        if (motion.simplified) {
            simplified_.push_back(name);
        }
        links_.at(below).above = above;
        connect(motion, name, above, below, document_.own_line(source.Element()));
    }

    /// Returns whether a link is the other one, or above it.
    bool is_above(const std::string& link, std::string other) const {
        while (other != link && !other.empty() && other != world_name) {
            other = links_.at(other).above;
        }
        return other == link;
    }

    /// Adds the joints of a motion. Each of them but the last leads to a link without geometry; where they turn about
    /// another point than the child's origin, the last one does so as well.
    void connect(const Motion& motion, const std::string& name, const std::string& above, const std::string& below,
                 int line) {
        const Pose parent = above == world_name ? Pose{} : links_.at(above).pose;
        Pose origin = parent.inverse() * links_.at(below).pose * Pose{.translation = motion.anchor};
        const bool moved = motion.anchor != Vec3{};
        std::string at = above;
        for (std::size_t i = 0; i < motion.joints.size(); ++i) {
            Joint joint = motion.joints[i];
            joint.name = unused(joint_names_, i == 0 ? name : fmt::format("{}_{}", name, i + 1));
            const bool last = i + 1 == motion.joints.size() && !moved;
            const std::string to = last ? below : unused(link_names(), below + "_" + name_alone(joint.name));
            put(std::move(joint), at, to, origin, line);
            if (!last) {
                links_[to] = {.pose = {}, .is_static = false, .above = at};
                robot_.links.push_back({.name = to, .collisions = {}, .visuals = {}});
            }
            at = to;
            origin = {};
        }
        if (moved) {
            put_rigid(Joint::Kind::fixed, name + "_fixed", at, below, {.translation = -motion.anchor});
        }
    }

    void put(Joint joint, const std::string& parent, const std::string& child, const Pose& origin, int line) {
        joint.parent = parent;
        joint.child = child;
        joint.origin = origin;
        joint.line = line;
        joint_names_.insert(joint.name);
        robot_.joints.push_back(std::move(joint));
    }

    void put_rigid(Joint::Kind kind, const std::string& name, const std::string& parent, const std::string& child,
                   const Pose& origin) {
        Joint joint;
        joint.kind = kind;
        joint.limited = false;
        joint.name = unused(joint_names_, name);
        put(std::move(joint), parent, child, origin, 0);
    }

    /// Makes the only link without a joint above it the root. Several stand in the link "world": those of static models
    /// fixed, others free.
    void add_root() {
        std::vector<std::string> roots;
        bool world = false;
        for (const auto& [name, link] : links_) {
            world = world || link.above == world_name;
        }
        for (const Link& link : robot_.links) {
            if (links_.at(link.name).above.empty()) {
                roots.push_back(link.name);
            }
        }
        robot_.root = roots.size() == 1 && !world ? roots.front() : world_name;
        if (robot_.root != world_name) {
            return;
        }
        robot_.links.insert(robot_.links.begin(), Link{.name = world_name, .collisions = {}, .visuals = {}});
        for (const std::string& root : roots) {
            const Placed& link = links_.at(root);
            put_rigid(link.is_static ? Joint::Kind::fixed : Joint::Kind::floating,
                      root + (link.is_static ? "_fixed" : "_free"), world_name, root, link.pose);
        }
    }

    void report() const {
        const auto warn = [&](const std::vector<std::string>& joints, const char* what) {
            if (!joints.empty()) {
                context_.log(Severity::warning,
                             fmt::format("{}: {}: {}", document_.file().string(), what, shown(first_names(joints))));
            }
        };
        warn(simplified_, "a ball, a screw and a slide without limits are read as floating, where the file has them");
        warn(gears_, "a gearbox couples joints, and foam moves them apart from each other");
        warn(loops_, "these joints close a loop; foam has trees, and leaves them out of the robot");
    }

    std::set<std::string> link_names() const {
        std::set<std::string> names;
        for (const auto& [name, link] : links_) {
            names.insert(name);
        }
        return names;
    }

    /// Returns the name, or one like it that no other has.
    static std::string unused(const std::set<std::string>& taken, const std::string& name) {
        std::string result = name;
        for (int i = 2; taken.contains(result); ++i) {
            result = name + "_" + std::to_string(i);
        }
        return result;
    }

    /// Returns a name without the models that it is in.
    static std::string name_alone(const std::string& name) {
        const std::size_t scope = name.rfind("::");
        return scope == name.npos ? name : name.substr(scope + 2);
    }

    const Document& document_;
    Shapes& shapes_;
    Context& context_;
    Robot robot_;
    std::map<std::string, Placed> links_;
    std::vector<std::pair<const ::sdf::Joint*, std::string>> joints_; ///< with what their names begin with
    std::set<std::string> joint_names_;
    std::vector<std::string> simplified_, gears_, loops_;
};

} // namespace

Robot robot_of(const std::string& text, const std::filesystem::path& file, const ResourceResolver& resources,
               const MeshLoader* meshes, Context& context) {
    References references(resources, file.parent_path());
    const Document document(text, file, references, context);
    Shapes shapes(document, references, {text, meshes}, context);
    Robot robot = Walk(document, shapes, context).run();
    shapes.report();
    robot.file = file;
    robot.source = text; // for write.sdf, which edits it
    robot.further_files = document.included();
    return robot;
}

} // namespace foam::load_sdf
