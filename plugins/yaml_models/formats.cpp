#include "formats.hpp"

#include <fmt/format.h>

#include <charconv>

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
        return; // a robot without spheres
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
    if (const Value& version = tree.at(root, "foam_spheres"); version.text != "1") {
        tree.fail(version, fmt::format("foam_spheres is {}; this foam reads 1", version.description()));
    }
    tree.for_each(tree.at(root, "links"),
                  [&](const std::string& link, const Value& value) { tree.add(link, tree.at(value, "spheres")); });
}

void read_xrdf(const Value& root, Tree& tree) {
    tree.result.format = "XRDF";
    if (const Value& format = tree.at(root, "format"); format.text != "xrdf") {
        tree.fail(format, fmt::format("expected the format xrdf, got {}", format.description()));
    }
    const Value* collision = root.find("world_collision");
    collision = collision ? collision : &tree.at(root, "collision");
    const std::string name = tree.at(*collision, "geometry").text;
    tree.note_buffer(*collision, "buffer_distance");
    tree.for_each(tree.at(tree.at(tree.at(root, "geometry"), name), "spheres"),
                  [&](const std::string& link, const Value& value) { tree.add(link, value); });
}

void read_curobo(const Value& root, Tree& tree) {
    tree.result.format = "cuRobo YAML";
    const Value* robot = root.is(Kind::map) ? root.find("robot_cfg") : nullptr;
    const Value& kinematics = tree.at(robot ? *robot : root, "kinematics");
    tree.note_buffer(kinematics, "collision_sphere_buffer");
    read_links(tree.at(kinematics, "collision_spheres"), tree);
}

void read_collision_spheres(const Value& root, Tree& tree) {
    tree.result.format = "collision_spheres YAML";
    tree.note_buffer(root, "collision_sphere_buffer");
    read_links(tree.at(root, "collision_spheres"), tree);
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
