// Poses of load.sdf against those that libsdformat resolves, on a file for each feature of the format.
#include "loading.hpp"

#include <foam/robot/kinematics.hpp>

#include <fmt/format.h>
#include <sdf/sdf.hh>

#include <algorithm>
#include <map>
#include <sstream>

namespace foam::test {
namespace {

/// A collision as libsdformat has it.
struct Theirs {
    ignition::math::Pose3d pose; ///< in the world
    std::string form;
};

using Placed = std::map<std::string, Theirs>; ///< by link and name

const std::string pose = "<pose>1 2 3 0.1 -0.4 0.7</pose>";

std::string posed_collision(const std::string& attributes) {
    return "<collision name='d'><pose" + attributes +
           ">0.1 0.2 0.3 0.3 0.2 0.1</pose><geometry><box><size>1 2 3</size></box></geometry></collision>";
}

struct Case {
    std::string name, text;
    std::filesystem::path file = "/none/robot.sdf";
};

const std::filesystem::path features = std::filesystem::path(FOAM_TEST_SOURCE) / "tests/load_sdf/features";

/// The files of tests/load_sdf/features, which use each feature of the format together.
std::vector<Case> files() {
    std::vector<Case> cases;
    for (const auto& entry : std::filesystem::directory_iterator(features)) {
        if (entry.is_regular_file()) {
            std::ostringstream text;
            text << std::ifstream(entry.path()).rdbuf();
            cases.push_back({entry.path().stem().string(), text.str(), entry.path()});
        }
    }
    std::ranges::sort(cases, {}, &Case::name);
    return cases;
}

template <class... Numbers>
std::string form(const char* name, Numbers... numbers) {
    std::string text = name;
    ((text += fmt::format(" {:.12g}", numbers)), ...);
    return text;
}

std::string form_of(const Geometry& geometry) {
    if (const auto* mesh = std::get_if<MeshReference>(&geometry)) {
        const bool read = !mesh->mesh;
        return read ? form("mesh", mesh->scale.x, mesh->scale.y, mesh->scale.z) + mesh->uri : "made";
    }
    const Element& element = std::get<Element>(geometry);
    const Vec3 half = element.half;
    switch (element.kind) {
    case Element::Kind::box:
        return form("box", 2 * half.x, 2 * half.y, 2 * half.z);
    case Element::Kind::sphere:
        return form("sphere", element.radius);
    case Element::Kind::ellipsoid:
        return form("ellipsoid", half.x, half.y, half.z);
    case Element::Kind::capsule:
        return form("capsule", element.radius, 2 * half.z);
    default:
        return form("cylinder", element.radius, 2 * half.z);
    }
}

/// What touches nothing, or stays as it is, has no form.
std::string form_of(const sdf::Collision& collision) {
    using Type = sdf::GeometryType;
    const sdf::Geometry& geometry = *collision.Geom();
    if (collision.Surface() && collision.Surface()->Contact() && collision.Surface()->Contact()->CollideBitmask() == 0) {
        return "";
    }
    switch (geometry.Type()) {
    case Type::BOX: {
        const auto size = geometry.BoxShape()->Size();
        return form("box", size.X(), size.Y(), size.Z());
    }
    case Type::SPHERE:
        return form("sphere", geometry.SphereShape()->Radius());
    case Type::CYLINDER:
        return form("cylinder", geometry.CylinderShape()->Radius(), geometry.CylinderShape()->Length());
    case Type::CAPSULE:
        return form("capsule", geometry.CapsuleShape()->Radius(), geometry.CapsuleShape()->Length());
    case Type::ELLIPSOID: {
        const auto radii = geometry.EllipsoidShape()->Radii();
        return form("ellipsoid", radii.X(), radii.Y(), radii.Z());
    }
    case Type::MESH: {
        const auto scale = geometry.MeshShape()->Scale();
        return form("mesh", scale.X(), scale.Y(), scale.Z()) + geometry.MeshShape()->Uri();
    }
    default:
        return geometry.Element()->HasElement("polyline") ? "made" : "";
    }
}

std::vector<Case> cases() {
    const std::string arm = "<link name='a'>" + pose + posed_collision("") + "</link>";
    const std::string fixed = joint("j", "fixed", "a", "b");
    return {
        {"one_link", model(arm)},
        {"degrees_and_quaternions",
         model("<link name='a'><pose degrees='true'>1 0 0 10 20 30</pose>" + posed_collision("") + "</link>" +
               link("b", "<pose rotation_format='quat_xyzw'>1 2 3 0.5 0.5 0.5 0.5</pose>") + fixed)},
        {"relative_to_link", model(arm + link("b", "<pose relative_to='a'>0 0 1 0.5 0 0</pose>") + fixed)},
        {"relative_to_joint", model(arm + link("b", "<pose relative_to='j'/>") +
                                    joint("j", "revolute", "a", "b",
                                          "<pose relative_to='a'>0 1 0 0 0.3 0</pose><axis><xyz>0 0 1</xyz></axis>"))},
        {"frames", model(arm + "<frame name='f' attached_to='a'><pose>0 0 2 1 0 0</pose></frame><frame name='g'>" + pose +
                         "</frame>" + link("b", "<pose relative_to='f'>1 0 0 0 0 1</pose>" + posed_collision(" relative_to='g'")) +
                         joint("j", "fixed", "f", "b"))},
        {"nested_models", model(arm + "<model name='inner'>" + pose + link("b", pose) + "<model name='core'>" + pose +
                                link("c", pose) + "</model></model>" + joint("j", "fixed", "a", "inner::b") +
                                joint("k", "fixed", "a", "inner::core::c"))},
        {"placement_frame", sdf("<model name='m' placement_frame='a'>" + pose + arm + link("b", pose) + fixed + "</model>")},
        {"world_of_one", sdf("<world name='w'><model name='m'>" + pose + arm + "</model></world>")},
        {"world_of_several", sdf("<world name='w'><model name='m'>" + pose + arm + "</model><model name='n'><static>1"
                                 "</static><pose relative_to='m'>1 0 0 0 1 0</pose>" + link("b", pose) + "</model></world>")},
        {"old_version", "<sdf version='1.5'><model name='m'>" + pose + arm + link("b", pose) +
                            joint("j", "revolute", "a", "b", "<pose>0 0 1 0 0 0</pose><axis><xyz>0 1 0</xyz>"
                                  "<use_parent_model_frame>true</use_parent_model_frame></axis>") + "</model></sdf>"},
        {"several_roots", model(arm + link("b", pose))},
    };
}

void add(Placed& placed, const sdf::Model& model, const std::string& prefix, const ignition::math::Pose3d& outer) {
    ignition::math::Pose3d own;
    EXPECT_TRUE(model.SemanticPose().Resolve(own).empty());
    for (std::uint64_t i = 0; i < model.LinkCount(); ++i) {
        const sdf::Link& link = *model.LinkByIndex(i);
        for (std::uint64_t k = 0; k < link.CollisionCount(); ++k) {
            ignition::math::Pose3d pose;
            const sdf::Collision& collision = *link.CollisionByIndex(k);
            EXPECT_TRUE(collision.SemanticPose().Resolve(pose, "__model__").empty());
            if (const std::string form = form_of(collision); !form.empty()) {
                placed[prefix + link.Name() + " " + collision.Name()] = {outer * own * pose, form};
            }
        }
    }
    for (std::uint64_t i = 0; i < model.ModelCount(); ++i) {
        const sdf::Model& inner = *model.ModelByIndex(i);
        add(placed, inner, prefix + inner.Name() + "::", outer * own);
    }
}

/// The collisions where libsdformat has them; it resolves from the collision to its model at once.
Placed placed_by_libsdformat(const std::string& text) {
    sdf::Console::Instance()->SetQuiet(true);
    sdf::Root root;
    sdf::ParserConfig config;
    config.SetFindCallback([](const std::string& uri) {
        return (features / uri.substr(uri.starts_with("model://") ? 8 : 0)).string();
    });
    EXPECT_TRUE(root.LoadSdfString(text, config).empty());
    Placed placed;
    if (root.Model()) {
        add(placed, *root.Model(), "", {});
    } else {
        const sdf::World& world = *root.WorldByIndex(0);
        for (std::uint64_t i = 0; i < world.ModelCount(); ++i) {
            const sdf::Model& model = *world.ModelByIndex(i);
            add(placed, model, world.ModelCount() > 1 ? model.Name() + "::" : "", {});
        }
    }
    return placed;
}

Vec3 moved(const ignition::math::Pose3d& pose, const Vec3& p) {
    const ignition::math::Vector3d v = pose.CoordPositionAdd(ignition::math::Vector3d(p.x, p.y, p.z));
    return {v.X(), v.Y(), v.Z()};
}

class LoadSdfPoses : public ::testing::TestWithParam<Case> {};

TEST_P(LoadSdfPoses, AreThoseOfLibsdformat) {
    QuietContext context;
    const Robot robot = load_sdf(GetParam().text, context, GetParam().file);
    const Placed expected = placed_by_libsdformat(GetParam().text);
    const std::map<std::string, Pose> links = link_poses(robot);
    EXPECT_EQ(links.size(), robot.links.size());
    // foam's poses are in the root link: two points of the first collision place it.
    std::size_t seen = 0;
    const Link* first = nullptr;
    for (const Link& link : robot.links) {
        first = first || link.collisions.empty() ? first : &link;
    }
    ASSERT_TRUE(first);
    const auto ours = [&](const Link& link, const GeometryElement& element, const Vec3& p) {
        return links.at(link.name) * element.origin * p;
    };
    const ignition::math::Pose3d& anchor = expected.at(first->name + " " + first->collisions.front().name).pose;
    const Pose to_anchor = (links.at(first->name) * first->collisions.front().origin).inverse();
    for (const Link& link : robot.links) {
        for (const GeometryElement& element : link.collisions) {
            const auto& [theirs, form] = expected.at(link.name + " " + element.name);
            EXPECT_EQ(form_of(element.geometry), form) << link.name << " " << element.name;
            for (const Vec3& p : {Vec3{}, Vec3{1, 0, 0}, Vec3{0, 1, 0}}) {
                const Vec3 in_world = moved(anchor, to_anchor * ours(link, element, p));
                EXPECT_LT(distance(in_world, moved(theirs, p)), 1e-12) << link.name << " " << element.name;
                if (robot.root == "world") {
                    EXPECT_LT(distance(ours(link, element, p), moved(theirs, p)), 1e-12) << link.name;
                }
            }
            ++seen;
        }
    }
    EXPECT_EQ(seen, expected.size());
}

INSTANTIATE_TEST_SUITE_P(Features, LoadSdfPoses, ::testing::ValuesIn(cases()),
                         [](const auto& info) { return info.param.name; });
INSTANTIATE_TEST_SUITE_P(Files, LoadSdfPoses, ::testing::ValuesIn(files()),
                         [](const auto& info) { return info.param.name; });

TEST(LoadSdfJoints, TurnAboutTheirOwnOrigin) {
    const Robot robot = load_sdf(model(link("a") + link("b", "<pose>0 0 1 0 0 0</pose>") +
                                       joint("j", "revolute", "a", "b",
                                             "<pose>0 0.5 0 0 0 0</pose><axis><xyz>0 0 1</xyz><limit><lower>-1</lower>"
                                             "<upper>2</upper></limit></axis>")));
    ASSERT_EQ(robot.joints.size(), 2U); // the second leads back to the link's own frame
    EXPECT_EQ(robot.joints[0].kind, Joint::Kind::revolute);
    EXPECT_EQ(robot.joints[0].lower, -1);
    EXPECT_EQ(robot.joints[1].kind, Joint::Kind::fixed);
    // Half a turn about the line through (0, 0.5, ·): the origin of b comes to y = 1.
    const Pose turned = link_poses(robot, {{"j", 3.14159265358979323846}}).at("b");
    EXPECT_LT(distance(turned.translation, {0, 1, 1}), 1e-12);
}

TEST(LoadSdfJoints, AxesAreExpressedInFrames) {
    const Robot robot = load_sdf(model(link("a") + link("b", "<pose>0 0 0 0 0 1.5707963267948966</pose>") +
                                       joint("j", "prismatic", "a", "b",
                                             "<pose>1 2 3 0 0 0</pose><axis><xyz expressed_in='a'>1 0 0</xyz><limit>"
                                             "<lower>0</lower><upper>1</upper></limit></axis>")));
    ASSERT_EQ(robot.joints.size(), 1U); // a slide has no point that it turns about
    EXPECT_LT(distance(robot.joints[0].axis, {0, -1, 0}), 1e-12);
    EXPECT_LT(distance(link_poses(robot, {{"j", 0.25}}).at("b").translation, {0.25, 0, 0}), 1e-12);
}

TEST(LoadSdfJoints, OfEveryType) {
    const std::string axis = "<axis><xyz>0 0 1</xyz></axis>", both = axis + "<axis2><xyz>1 0 0</xyz></axis2>";
    using Kind = Joint::Kind;
    const auto kinds = [&](const std::string& type, const std::string& more) {
        std::vector<Kind> found;
        for (const Joint& joint : load_sdf(model(link("a") + link("b") + joint("j", type, "a", "b", more))).joints) {
            found.push_back(joint.kind);
        }
        return found;
    };
    EXPECT_EQ(kinds("fixed", ""), std::vector{Kind::fixed});
    EXPECT_EQ(kinds("revolute", axis), std::vector{Kind::continuous});
    EXPECT_EQ(kinds("continuous", axis), std::vector{Kind::continuous});
    EXPECT_EQ(kinds("prismatic", axis), std::vector{Kind::floating});
    EXPECT_EQ(kinds("ball", ""), std::vector{Kind::floating});
    EXPECT_EQ(kinds("screw", axis), std::vector{Kind::floating});
    EXPECT_EQ(kinds("universal", both), (std::vector{Kind::continuous, Kind::continuous}));
    EXPECT_EQ(kinds("revolute2", both), (std::vector{Kind::continuous, Kind::continuous}));
}

} // namespace
} // namespace foam::test
