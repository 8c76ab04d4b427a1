#include "bodies.hpp"

#include "joints.hpp"
#include "orientation.hpp"

#include <foam/base/cancellation.hpp>

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <set>

namespace foam::mjcf {
namespace {

constexpr std::size_t most_elements = 1'000'000; ///< of <replicate> in <replicate>
constexpr int deepest_attachment = 50;

/// Where an element stands.
struct Scope {
    const Model* model = nullptr;
    std::string prefix{}, suffix{}; ///< of names, from <attach> and <replicate>
    std::string childclass{};
    Pose frame{}; ///< of the <frame> elements, in the body's frame
    int depth = 0;

    std::string named(const std::string& name) const { return prefix + name + suffix; }
};

struct Item {
    const Node* node;
    Scope scope;
};

/// The content of a body: its elements, with those in frames, copies and attached models.
class Content {
public:
    std::vector<Item> items;

    void add_children(const Node& node, const Scope& scope) {
        for (const Node& child : node.children) {
            add(child, scope);
        }
    }

private:
    void add(const Node& node, const Scope& scope) {
        const std::string& name = node.name();
        if (name == "frame") {
            Scope inner = scope;
            inner.frame = scope.frame * pose_of(Attributes(node), scope.model->settings);
            inner.childclass = scope.model->classes.childclass_of(node, scope.childclass);
            add_children(node, inner);
        } else if (name == "replicate") {
            replicate(node, scope);
        } else if (name == "attach") {
            attach(node, scope);
        } else if (name == "composite") {
            node.fail("<composite> is not read; remedy: let MuJoCo write it out, by mujoco.mj_saveLastXML()");
        } else {
            items.push_back({&node, scope});
            if (items.size() > most_elements) {
                node.fail("<replicate> makes more than a million elements; remedy: a smaller count");
            }
        }
    }

    /// Adds the copies of what <replicate> holds; each stands in the frame of the one before it.
    void replicate(const Node& node, const Scope& scope) {
        const Attributes attributes(node);
        const double count = attributes.number("count").value_or(0);
        if (!(count >= 1 && count <= most_elements) || count != std::floor(count)) {
            attributes.fail("count", "it expects a whole number of at least 1");
        }
        const Vec3 offset = attributes.vector("offset").value_or(Vec3{});
        const Vec3 turn = attributes.vector("euler").value_or(Vec3{});
        const std::size_t digits = std::to_string(static_cast<std::size_t>(count)).size();
        Vec3 position;
        for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
            const Vec3 angles = turn * static_cast<double>(i);
            Pose own = of_euler(std::array{angles.x, angles.y, angles.z}, scope.model->settings);
            own.translation = position;
            position = own * offset;
            Scope inner = scope;
            inner.frame = scope.frame * own;
            inner.childclass = scope.model->classes.childclass_of(node, scope.childclass);
            inner.suffix = attributes.word("sep") + fmt::format("{:0{}}", i, digits) + scope.suffix;
            add_children(node, inner);
        }
    }

    /// Adds a body, a frame or the whole world of another model, or of the same one.
    void attach(const Node& node, const Scope& scope) {
        Scope inner = scope;
        inner.prefix += node.required("prefix");
        inner.childclass.clear();
        if (++inner.depth > deepest_attachment) {
            node.fail("<attach> leads to itself");
        }
        if (const std::string* model = node.attribute("model")) {
            const auto found = scope.model->models.find(*model);
            if (found == scope.model->models.end()) {
                node.fail(fmt::format("there is no model '{}'; remedy: <asset><model name=\"…\" file=\"…\"/></asset>",
                                      *model));
            }
            inner.model = found->second.get();
        }
        for (const char* kind : {"body", "frame"}) {
            if (const std::string* name = node.attribute(kind)) {
                const auto found = inner.model->find(kind, *name);
                if (!found) {
                    node.fail(fmt::format("there is no {} '{}' to attach", kind, *name));
                }
                inner.childclass = found->childclass;
                add(*found->node, inner);
                return;
            }
        }
        for (const Node* world : inner.model->document.root().children_named("worldbody")) {
            add_children(*world, inner);
        }
    }
};

class Walk {
public:
    Tree run(const Model& model) {
        const std::string* name = model.document.root().attribute("model");
        tree_.robot.name = name && !name->empty() ? *name : model.document.root().file->path.stem().string();
        tree_.robot.root = "world";
        add_link("world");
        Content content;
        for (const Node* world : model.document.root().children_named("worldbody")) {
            content.add_children(*world, {.model = &model});
        }
        add_content(content, "world", 0);
        mark_pairs(model);
        return std::move(tree_);
    }

private:
    /// Returns the name, or one like it that no other has.
    static std::string unused(const std::set<std::string>& taken, const std::string& name) {
        std::string result = name;
        for (int i = 2; taken.contains(result); ++i) {
            result = name + "_" + std::to_string(i);
        }
        return result;
    }

    std::size_t add_link(const std::string& name) {
        links_.insert(name);
        tree_.robot.links.push_back({.name = name, .collisions = {}, .visuals = {}});
        return tree_.robot.links.size() - 1;
    }

    void add_joint(Joint joint, const std::string& parent, const std::string& child, const Pose& origin) {
        joint.parent = parent;
        joint.child = child;
        joint.origin = origin * joint.origin;
        joint.name = unused(joints_, joint.name);
        joints_.insert(joint.name);
        tree_.robot.joints.push_back(std::move(joint));
    }

    void add_body(const Item& item, const std::string& parent) {
        const auto& [node, scope] = item;
        const std::string* stated = node->attribute("name");
        const std::string number = "body_" + std::to_string(++bodies_);
        const std::string name = stated && !stated->empty() ? scope.named(*stated) : unused(links_, number);
        if (links_.contains(name)) {
            node->fail(fmt::format("a second body '{}'; remedy: another name", name));
        }
        const Attributes attributes(*node);
        Content content;
        Scope inner = scope;
        inner.childclass = scope.model->classes.childclass_of(*node, scope.childclass);
        inner.frame = {};
        content.add_children(*node, inner);
        links_.insert(name); // before the links of its joints
        add_joints(content, parent, name, scope.frame * pose_of(attributes, scope.model->settings),
                   attributes.flag("mocap", false));
        add_content(content, name, add_link(name));
    }

    /// Adds the joints between two links. Each of them but the last leads to a link without geometry; where the last
    /// one turns about another point than the body's origin, it does so as well.
    void add_joints(const Content& content, const std::string& parent, const std::string& body, const Pose& pose,
                    bool mocap) {
        std::vector<BodyJoint> joints;
        for (const auto& [node, scope] : content.items) {
            if (node->name() == "joint" || node->name() == "freejoint") {
                const Attributes attributes =
                    node->name() == "joint" ? scope.model->classes.of(*node, scope.childclass) : Attributes(*node);
                BodyJoint& joint = joints.emplace_back(joint_of(*node, attributes, scope.model->settings, scope.frame));
                const std::string* name = node->attribute("name");
                joint.joint.name = name && !name->empty() ? scope.named(*name) : "joint_" + std::to_string(joint_);
                ++joint_;
            }
        }
        Pose before = pose;
        Vec3 anchor;
        std::string above = parent;
        for (std::size_t i = 0; i < joints.size(); ++i) {
            const Vec3 next = joints[i].has_anchor ? joints[i].anchor : anchor;
            const bool last = i + 1 == joints.size() && next == Vec3{};
            const std::string below = last ? body : unused(links_, body + "_" + joints[i].joint.name);
            add_joint(joints[i].joint, above, below, before * Pose{.translation = next - anchor});
            if (!last) {
                add_link(below);
            }
            above = below;
            anchor = next;
            before = {};
        }
        if (above != body) {
            Joint fixed;
            fixed.kind = mocap ? Joint::Kind::floating : Joint::Kind::fixed;
            fixed.name = body + (mocap ? "_mocap" : "_fixed");
            add_joint(std::move(fixed), above, body, before * Pose{.translation = -anchor});
        }
    }

    /// Adds the geoms, the mass and the bodies below a link.
    void add_content(const Content& content, const std::string& name, std::size_t link) {
        CancellationCounter asking(64);
        for (const Item& item : content.items) {
            asking.check();
            if (item.node->name() == "geom") {
                add_geom(item, link);
            } else if (item.node->name() == "inertial") {
                tree_.robot.links[link].inertial = inertial_of(item);
            }
        }
        for (const Item& item : content.items) {
            if (item.node->name() == "body") {
                add_body(item, name);
            }
        }
    }

    void add_geom(const Item& item, std::size_t link) {
        const auto& [node, scope] = item;
        const std::string* stated = node->attribute("name");
        Geom geom{.attributes = scope.model->classes.of(*node, scope.childclass), .node = node, .model = scope.model};
        geom.frame = scope.frame;
        geom.link = link;
        if (stated) {
            geom.name = scope.named(*stated);
            named_.push_back({tree_.geoms.size(), *stated, scope.prefix, scope.suffix});
            names_.insert(geom.name);
        }
        tree_.geoms.push_back(std::move(geom));
    }

    /// Marks the geoms of each <pair> whose geoms both exist, of the model and of each that it attaches.
    void mark_pairs(const Model& main) {
        const auto mark = [&](std::size_t geom, const std::string& name, const auto& pairs, const auto& full) {
            for (const auto& [first, second] : pairs) {
                const bool names_it = name == first || name == second;
                tree_.geoms[geom].paired |= names_it && names_.contains(full(name == first ? second : first));
            }
        };
        for (const Named& named : named_) {
            const Geom& geom = tree_.geoms[named.geom];
            mark(named.geom, named.stated, geom.model->pairs,
                 [&](const std::string& other) { return named.prefix + other + named.suffix; });
            mark(named.geom, geom.name, main.pairs, [](const std::string& other) { return other; });
        }
    }

    static Inertial inertial_of(const Item& item) {
        Inertial inertial;
        inertial.line = item.node->element->line;
        try {
            const Attributes attributes(*item.node);
            inertial.origin = pose_of(attributes, item.scope.model->settings);
            inertial.mass = attributes.number("mass");
            const std::vector<double> full = attributes.numbers("fullinertia", 6, 6);
            const std::vector<double> own = attributes.numbers("diaginertia", 3, 3);
            if (!full.empty()) {
                inertial.moments = std::array{full[0], full[1], full[2], full[3], full[4], full[5]};
            } else if (!own.empty()) {
                inertial.moments = std::array{own[0], own[1], own[2], 0.0, 0.0, 0.0};
            }
        } catch (const Error& error) {
            inertial.problem = error.what();
        }
        return inertial;
    }

    /// A geom with a name, as its model states it.
    struct Named {
        std::size_t geom;
        std::string stated, prefix, suffix;
    };

    Tree tree_;
    std::vector<Named> named_;
    std::set<std::string> names_; ///< of geoms
    std::set<std::string> links_, joints_;
    std::size_t bodies_ = 0, joint_ = 0;
};

} // namespace

Tree tree_of(const Model& model) {
    return Walk().run(model);
}

} // namespace foam::mjcf
