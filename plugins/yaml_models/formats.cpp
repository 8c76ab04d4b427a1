#include "tree_writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <set>

namespace foam::tree {
namespace {

using yaml::Value;
using Kind = Value::Kind;

void read_links(const Value& spheres, Tree& tree) {
    const auto add_link = [&](const std::string& link, const Value& value) {
        if (value.is(Kind::map)) {
            tree.result.format = "plainmp YAML";
            tree.add(link, tree.at(value, "spheres"));
        } else {
            tree.add(link, value);
        }
    };
    if (spheres.is(Kind::null)) {
        tree.fail(spheres, "collision_spheres is null: there are no spheres in this file; remedy: `foam convert MODEL "
                           "--into FILE -o OUT` writes those of a model into it");
    }
    if (spheres.is(Kind::text)) {
        tree.fail(spheres, fmt::format("the spheres are in another file, '{}'; remedy: give that one", spheres.text));
    }
    if (spheres.is(Kind::list)) {
        tree.result.format = "Lula YAML";
        for (const Value& entry : spheres.items) {
            tree.for_each(entry, add_link);
        }
        return;
    }
    tree.for_each(spheres, add_link);
}

/// Returns the value of the largest key; all keys are numbers.
const Value& largest_key(const Value& map, std::string_view what, const Tree& tree) {
    const Value* best = nullptr;
    long largest = -1;
    tree.for_each(map, [&](const std::string& key, const Value& value) {
        long n = -1;
        const auto [end, error] = std::from_chars(key.data(), key.data() + key.size(), n);
        if (error != std::errc{} || end != key.data() + key.size()) {
            tree.fail(value, fmt::format("'{}' is not a {}", key, what));
        }
        if (n > largest) {
            largest = n;
            best = &value;
        }
    });
    if (!best) {
        tree.fail(map, fmt::format("there is no {}", what));
    }
    return *best;
}

/// Leaves out the links that cuRobo's list does not name, with a note.
void keep_named_links(const Value& kinematics, Tree& tree) {
    const Value* named = kinematics.find("collision_link_names");
    if (!named || !named->is(Kind::list)) {
        return;
    }
    const auto is_named = [&](const LinkSpheres& link) {
        return std::any_of(named->items.begin(), named->items.end(),
                           [&](const Value& name) { return name.text == link.link; });
    };
    for (const LinkSpheres& link : tree.result.links) {
        if (!is_named(link)) {
            tree.result.notes.push_back(fmt::format(
                "{} sphere{} of link '{}' {} left out: collision_link_names (line {}) does not name it, so that cuRobo "
                "does not use that link",
                link.elements.spheres().size(), link.elements.spheres().size() == 1 ? "" : "s", link.link,
                link.elements.spheres().size() == 1 ? "is" : "are", named->where.line));
        }
    }
    std::erase_if(tree.result.links, [&](const LinkSpheres& link) { return !is_named(link); });
}

/// The geometry of an XRDF: named groups of spheres, which may clone others.
class GeometryGroups {
public:
    GeometryGroups(const Value& groups, Tree& tree) : groups_(groups), tree_(tree) {}

    /// Adds the spheres of a group and of those that it clones, each group once. Precondition: the group exists.
    void add(const std::string& name) {
        if (!added_.insert(name).second) {
            return;
        }
        open_.push_back(name);
        const Value& group = *groups_.find(name);
        const Value* clone = group.is(Kind::map) ? group.find("clone") : nullptr;
        const Value* spheres = group.is(Kind::map) ? group.find("spheres") : nullptr;
        if (!clone && !spheres) {
            tree_.fail(group,
                       fmt::format("geometry '{}' has neither spheres nor clone; remedy: add one of them", name));
        }
        if (clone && clone->is(Kind::list)) {
            std::for_each(clone->items.begin(), clone->items.end(), [&](const Value& item) { add_clone(item); });
        } else if (clone) {
            add_clone(*clone);
        }
        if (spheres) {
            tree_.for_each(*spheres, [&](const std::string& link, const Value& value) { tree_.add(link, value); });
        }
        open_.pop_back();
    }

private:
    void add_clone(const Value& name) {
        if (!name.is(Kind::text)) {
            tree_.fail(name, fmt::format("expected the name of a geometry, got {}", name.description()));
        }
        if (!groups_.find(name.text)) {
            tree_.fail(name, fmt::format("'{}' is cloned, but there is no such geometry; there is {}", name.text,
                                         fmt::join(names(), ", ")));
        }
        if (std::find(open_.begin(), open_.end(), name.text) != open_.end()) {
            tree_.fail(name, fmt::format("geometry '{}' clones itself; remedy: delete this name", name.text));
        }
        add(name.text);
    }

    std::vector<std::string> names() const {
        std::vector<std::string> all;
        for (const yaml::Key& key : groups_.keys) {
            all.push_back(key.text);
        }
        return all;
    }

    const Value& groups_;
    Tree& tree_;
    std::set<std::string> added_;
    std::vector<std::string> open_; ///< groups that are being added, each cloned by the one before
};

/// Reads one object per depth, the last the finest.
void read_depths(const Value& root, Tree& tree) {
    tree.result.format = "list of CoMMALab/foam";
    if (root.items.empty()) {
        tree.fail(root, "the list of depths is empty");
    }
    const Value& finest = root.items.back();
    const Value* link = finest.is(Kind::map) ? finest.find("link") : nullptr;
    tree.add(link ? link->text : "", tree.at(finest, "spheres"));
}

} // namespace

void read_foam_json(const Value& root, Tree& tree) {
    tree.result.format = "foam JSON";
    if (const Value& version = tree.at(root, "foam_spheres"); version.text != "1" && version.text != "2") {
        tree.fail(version, fmt::format("foam_spheres is {}; this foam reads 1 and 2", version.description()));
    }
    for (const auto& [key, only] : {std::pair("units", "m"), std::pair("frame", "link")}) {
        if (const Value* value = root.find(key); value && value->text != only) {
            tree.fail(*value, fmt::format("{} is {}; foam reads '{}' alone; remedy: convert the numbers", key,
                                          value->description(), only));
        }
    }
    tree.for_each(tree.at(root, "links"), [&](const std::string& link, const Value& value) {
        tree.add(link, tree.at(value, "spheres"));
        if (const Value* elements = value.find("elements")) {
            tree.add_elements(link, *elements);
        }
    });
}

void read_xrdf(const Value& root, Tree& tree) {
    tree.result.format = "XRDF";
    if (const Value& format = tree.at(root, "format"); format.text != "xrdf") {
        tree.fail(format, fmt::format("expected the format xrdf, got {}", format.description()));
    }
    const bool is_new = root.find("world_collision") != nullptr;
    const Value& collision = tree.at(root, is_new ? "world_collision" : "collision");
    const std::string name = tree.at(collision, "geometry").text;
    const Value& groups = tree.at(root, "geometry");
    tree.at(groups, name);
    GeometryGroups(groups, tree).add(name);
    tree.read_buffer(collision, "buffer_distance");
    const Value* self = root.find("self_collision");
    if (self) {
        tree.note_self_buffer(*self, "buffer_distance");
    }
    const Value* own = self && self->is(Kind::map) ? self->find("geometry") : nullptr;
    if (own && own->text != name) {
        tree.result.notes.push_back(
            fmt::format("self_collision (line {}) has a geometry of its own, '{}', which is not judged: '{}' of {} is",
                        own->where.line, own->text, name, is_new ? "world_collision" : "collision"));
    }
}

void read_curobo(const Value& root, Tree& tree) {
    tree.result.format = "cuRobo YAML";
    const Value* robot = root.is(Kind::map) ? root.find("robot_cfg") : nullptr;
    const Value& kinematics = tree.at(robot ? *robot : root, "kinematics");
    read_links(tree.at(kinematics, "collision_spheres"), tree);
    keep_named_links(kinematics, tree);
    tree.read_buffer(kinematics, "collision_sphere_buffer");
    tree.note_self_buffer(kinematics, "self_collision_buffer");
}

void read_collision_spheres(const Value& root, Tree& tree) {
    tree.result.format = "collision_spheres YAML";
    read_links(tree.at(root, "collision_spheres"), tree);
    tree.read_buffer(root, "collision_sphere_buffer");
}

void read_columns(const Value& root, Tree& tree) {
    if (root.is(Kind::map) && root.find("centers") && root.find("radii")) {
        tree.result.format = "MorphIt JSON";
        const Value* link = root.find("link"); // of write.morphit; other keys are free
        tree.add_columns(link ? link->text : "", root);
        return;
    }
    tree.result.format = "centers and radii by link";
    tree.for_each(root, [&](const std::string& link, const Value& value) { tree.add_columns(link, value); });
}

void read_spheres_by_link(const Value& root, Tree& tree) {
    tree.result.format = "spheres by link";
    tree.for_each(tree.at(root, "spheres"), [&](const std::string& link, const Value& list) { tree.add(link, list); });
}

void read_commalab(const Value& root, Tree& tree) {
    if (root.is(Kind::list)) {
        read_depths(root, tree);
        return;
    }
    tree.result.format = "database of CoMMALab/foam";
    tree.for_each(root, [&](const std::string& key, const Value& branches) {
        const Value& depths = largest_key(branches, "branch", tree);
        tree.add(key.substr(0, key.rfind("::")), tree.at(largest_key(depths, "depth", tree), "spheres"));
    });
}

} // namespace foam::tree
