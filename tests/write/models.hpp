// Models for the tests of writers.
#pragma once

#include <foam/base/error.hpp>
#include <foam/sdk/model.hpp>
#include <foam/sdk/registry.hpp>

#include <gtest/gtest.h>

#include <string>

namespace foam::test {

inline std::unique_ptr<Writer> writer(const std::string& plugin, const std::string& stage,
                                      const std::map<std::string, ParameterValue>& parameters = {}) {
    Registry registry;
    const PluginRecord& record = registry.load(std::string(FOAM_TEST_PLUGINS "/") + plugin + ".so");
    EXPECT_TRUE(record.loaded()) << record.rejection;
    return registry.make<Writer>(stage, parameters);
}

/// Parameters that a writer needs for links of these names.
inline std::map<std::string, ParameterValue> needed_parameters(const std::string& stage,
                                                               const std::vector<std::string>& links) {
    if (stage != "write.gpmp2") {
        return {};
    }
    std::string frames;
    for (const std::string& link : links) {
        frames += link + " 0 0 0 0 0 0 0\n";
    }
    return {{"frames", frames}};
}

/// A robot whose links have one collision element each, a chain of fixed joints in their order.
inline std::shared_ptr<const Robot> chain_of(const std::vector<std::string>& links) {
    auto robot = std::make_shared<Robot>();
    robot->name = "chain";
    robot->root = links.front();
    robot->file = "/none/chain.urdf";
    const auto escaped = [](const std::string& name) {
        std::string text;
        for (const char c : name) {
            text += c == '&'    ? "&amp;"
                    : c == '"'  ? "&quot;"
                    : c == '<'  ? "&lt;"
                    : c == '\n' ? "&#10;"
                                : std::string(1, c);
        }
        return text;
    };
    robot->source = "<robot name=\"chain\">\n";
    for (std::size_t i = 0; i < links.size(); ++i) {
        GeometryElement box;
        box.geometry = Element::box({1, 1, 1});
        Link link;
        link.name = links[i];
        link.collisions.push_back(box);
        robot->links.push_back(link);
        robot->source += "  <link name=\"" + escaped(links[i]) +
                         "\">\n    <collision><geometry><box size=\"1 1 1\"/></geometry></collision>\n  </link>\n";
        if (i > 0) {
            Joint joint;
            joint.name = "joint" + std::to_string(i);
            joint.parent = links[i - 1];
            joint.child = links[i];
            joint.origin.translation = {0, 0, 1};
            robot->joints.push_back(joint);
            robot->source += "  <joint name=\"joint" + std::to_string(i) + "\" type=\"fixed\"><parent link=\"" +
                             escaped(links[i - 1]) + "\"/><child link=\"" + escaped(links[i]) +
                             "\"/><origin xyz=\"0 0 1\"/></joint>\n";
        }
    }
    robot->source += "</robot>\n";
    return robot;
}

/// A robot whose only link with spheres turns on a base without geometry.
inline std::shared_ptr<const Robot> turning(const std::string& link) {
    auto robot = std::make_shared<Robot>(*chain_of({"base", link}));
    robot->joints[0].kind = Joint::Kind::revolute;
    robot->joints[0].lower = -1;
    robot->joints[0].upper = 2;
    robot->joints[0].origin = {}; // some formats have no poses
    robot->links[0].collisions.clear();
    const std::string element = "    <collision><geometry><box size=\"1 1 1\"/></geometry></collision>\n";
    robot->source.erase(robot->source.find(element), element.size());
    const std::string away = "xyz=\"0 0 1\"";
    robot->source.replace(robot->source.find(away), away.size(), "xyz=\"0 0 0\"");
    robot->links[0].inertial = Inertial{.mass = 1, .moments = std::array<double, 6>{1, 1, 1, 0, 0, 0}, .origin = {}};
    const std::string fixed = "type=\"fixed\">";
    robot->source.replace(robot->source.find(fixed), fixed.size(),
                          "type=\"revolute\"><limit lower=\"-1\" upper=\"2\" effort=\"1\" velocity=\"1\"/>");
    return robot;
}

/// Coordinates that a careless writer loses: signs, many digits, very small and very large.
inline std::vector<Sphere> awkward_spheres() {
    return {{{0.1, -0.2, 1.0 / 3}, 0.05},
            {{-0.0, 1e-17, -1e-300}, 5e-324},
            {{123456.789, 1e22, -9007199254740993.0}, 1e17},
            {{0.30000000000000004, 2.2250738585072014e-308, 1}, 0.1 + 0.7}};
}

inline SphereGroup group_of(std::string link, std::vector<std::string> geometries, SphereTree tree) {
    SphereGroup group;
    group.link = std::move(link);
    group.geometries = std::move(geometries);
    group.tree = std::move(tree);
    return group;
}

inline SphereModel model_of(std::shared_ptr<const Robot> robot, std::vector<SphereGroup> groups) {
    SphereModel model;
    model.name = "test";
    model.robot = std::move(robot);
    model.groups = std::move(groups);
    if (model.robot && !model.robot->links.empty()) {
        model.facts.tool_frames = {model.robot->links.back().name};
    }
    return model;
}

/// Two links, the first with two groups, each a tree of three levels.
inline SphereModel awkward_model() {
    SphereTree tree = flat_tree({{{0, 0, 0}, 1}, {{1, 0, 0}, 1}});
    tree.levels.push_back({awkward_spheres(), {0, 1, 1, 0}});
    Measures measures;
    measures.spheres = 4;
    measures.excess = 0.25;
    measures.certified = true;
    return model_of(chain_of({"first, \"link\" & <more>", "second"}),
                    {{.link = "first, \"link\" & <more>", .geometries = {"b.stl"}, .tree = tree, .measures = measures},
                     {.link = "first, \"link\" & <more>", .geometries = {"b.stl"}, .tree = tree, .measures = measures},
                     {.link = "second", .geometries = {"box", "a.stl"}, .tree = tree, .measures = measures}});
}

/// What a writer's read() must give for the model.
inline std::map<std::string, std::vector<Sphere>> spheres_of(const SphereModel& model, int level = -1) {
    std::map<std::string, std::vector<Sphere>> result;
    for (const LinkSpheres& link : spheres_by_link(model, level)) {
        result[link.link] = link.elements.spheres();
    }
    return result;
}

inline std::string refusal(const Writer& writer, const SphereModel& model) {
    QuietContext context;
    try {
        writer.write(model, context);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::output);
        return error.what();
    }
    return {};
}

} // namespace foam::test
