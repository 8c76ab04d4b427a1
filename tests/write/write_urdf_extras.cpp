// What parameters of write.urdf add to the text: <inertial>, Drake's elements; and paths as package://.
#include "models.hpp"
#include "support/temporary_folder.hpp"
#include "support/read_spheres.hpp"

#include <foam/base/file.hpp>

#include <foam/geometry/element_forms.hpp>

#include <gmock/gmock.h>

#include <fstream>

namespace foam::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

class Hearing final : public QuietContext {
public:
    void log(Severity severity, std::string_view message) override {
        said.push_back((severity == Severity::warning ? "warning: " : "note: ") + std::string(message));
    }
    std::vector<std::string> said;
};

const char* const arm = R"(<robot name="arm">
  <link name="base"><collision><geometry><box size="1 2 3"/></geometry></collision></link>
  <link name="foot"><collision><geometry><box size="1 1 1"/></geometry></collision></link>
  <link name="upper">
    <collision><geometry><box size="1 2 3"/></geometry></collision>
  </link>
  <link name="tool"><inertial><mass value="5"/></inertial></link>
  <link name="frame"/>
  <link name="bare"/>
  <joint name="turn" type="revolute"><parent link="base"/><child link="upper"/><axis xyz="0 0 1"/>
    <limit lower="0" upper="2" effort="1" velocity="1"/></joint>
  <joint name="stand" type="fixed"><parent link="base"/><child link="foot"/></joint>
  <joint name="weld" type="fixed"><parent link="upper"/><child link="tool"/></joint>
  <joint name="mark" type="fixed"><parent link="upper"/><child link="frame"/></joint>
  <joint name="spin" type="continuous"><parent link="upper"/><child link="bare"/></joint>
</robot>
)";

void expect_equal(const Pose& a, const Pose& b) {
    EXPECT_EQ(a.translation, b.translation);
    for (std::size_t row = 0; row < 3; ++row) {
        EXPECT_LT(norm(a.rotation[row] - b.rotation[row]), 1e-15);
    }
}

/// Returns the elements with capsules in the parts that plain URDF has words for.
std::vector<GeometryElement> in_parts(const std::vector<GeometryElement>& elements) {
    std::vector<GeometryElement> result;
    for (const GeometryElement& element : elements) {
        const auto* primitive = std::get_if<Element>(&element.geometry);
        if (!primitive || primitive->kind != Element::Kind::capsule) {
            result.push_back(element);
            continue;
        }
        for (const Element& part : capsule_parts(*primitive)) {
            GeometryElement& added = result.emplace_back(element);
            added.name = part.kind == Element::Kind::cylinder ? element.name : "";
            added.origin = element.origin * part.pose;
            Element centred = part;
            centred.pose = {};
            added.geometry = centred;
        }
    }
    return result;
}

/// `whole`: with capsules, `a` with their parts.
void expect_equal(const std::vector<GeometryElement>& a, const std::vector<GeometryElement>& whole) {
    const std::vector<GeometryElement> b = in_parts(whole);
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        EXPECT_EQ(a[i].name, b[i].name);
        expect_equal(a[i].origin, b[i].origin);
        ASSERT_EQ(a[i].geometry.index(), b[i].geometry.index());
        if (const auto* mesh = std::get_if<MeshReference>(&a[i].geometry)) {
            EXPECT_EQ(mesh->uri, std::get<MeshReference>(b[i].geometry).uri);
            EXPECT_EQ(mesh->scale, std::get<MeshReference>(b[i].geometry).scale);
        } else {
            EXPECT_EQ(std::get<Element>(a[i].geometry), std::get<Element>(b[i].geometry));
        }
        ASSERT_EQ(a[i].material == nullptr, b[i].material == nullptr);
        if (a[i].material) {
            EXPECT_EQ(a[i].material->name, b[i].material->name);
            EXPECT_EQ(a[i].material->rgba, b[i].material->rgba);
            EXPECT_EQ(a[i].material->texture, b[i].material->texture);
        }
    }
}

void expect_equal(const Link& a, const Link& b) {
    SCOPED_TRACE(b.name);
    EXPECT_EQ(a.name, b.name);
    expect_equal(a.collisions, b.collisions);
    expect_equal(a.visuals, b.visuals);
    ASSERT_EQ(a.inertial.has_value(), b.inertial.has_value());
    if (a.inertial) {
        EXPECT_EQ(a.inertial->mass, b.inertial->mass);
        EXPECT_EQ(a.inertial->moments, b.inertial->moments);
        expect_equal(a.inertial->origin, b.inertial->origin);
    }
}

void expect_equal(const Joint& a, const Joint& b) {
    SCOPED_TRACE(b.name);
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.kind, b.kind);
    EXPECT_EQ(a.parent, b.parent);
    EXPECT_EQ(a.child, b.child);
    expect_equal(a.origin, b.origin);
    EXPECT_LT(norm(a.axis - b.axis), 1e-15);
    EXPECT_EQ(std::tie(a.lower, a.upper, a.limited, a.effort, a.velocity, a.damping, a.friction),
              std::tie(b.lower, b.upper, b.limited, b.effort, b.velocity, b.damping, b.friction));
    ASSERT_EQ(a.mimic.has_value(), b.mimic.has_value());
    if (a.mimic) {
        EXPECT_EQ(std::tie(a.mimic->joint, a.mimic->multiplier, a.mimic->offset),
                  std::tie(b.mimic->joint, b.mimic->multiplier, b.mimic->offset));
    }
}

class WriteUrdfExtras : public testing::Test {
protected:
    WriteUrdfExtras() {
        EXPECT_TRUE(registry_.load(FOAM_TEST_PLUGINS "/write_urdf.so").loaded());
        EXPECT_TRUE(registry_.load(FOAM_TEST_PLUGINS "/load_urdf.so").loaded());
        use(arm);
        model_.groups = {group_of("base", {}, flat_tree({{{0, 0, 0}, 2}})),
                         group_of("upper", {}, flat_tree({{{0, 0, 0}, 2}, {{0, 1, 0}, 2}}))};
        model_.ignored_pairs = {{"base", "upper", "Adjacent"}, {"upper", "tool", ""}};
    }

    void use(const std::string& text) {
        QuietContext quiet;
        model_.robot = std::make_shared<Robot>(
            registry_.make<RobotLoader>("load.urdf")->load(text, "/none/arm.urdf", ResourceResolver(), quiet));
        for (const Link& link : model_.robot->links) {
            if (!link.collisions.empty()) {
                model_.geometry[link.name] =
                    Solid::make({{nullptr, std::get<Element>(link.collisions[0].geometry), Pose{}}});
            }
        }
    }
    std::string written(const std::map<std::string, ParameterValue>& parameters) {
        context_.said.clear();
        const std::string text = registry_.make<Writer>("write.urdf", parameters)->write(model_, context_);
        EXPECT_EQ(read_spheres(*registry_.make<Writer>("write.urdf"), text), spheres_of(model_));
        return text;
    }

    Registry registry_;
    SphereModel model_;
    Hearing context_;
};

const std::string inertial = "<inertial><!-- foam: collision geometry at 1000 kg/m3 --><origin xyz=\"0 0 0\" rpy=\"0 0 "
                             "0\"/><mass value=\"6000\"/><inertia "
                             "ixx=\"6500\" ixy=\"0\" ixz=\"0\" iyy=\"5000\" iyz=\"0\" izz=\"2500\"/></inertial>";

TEST_F(WriteUrdfExtras, MovingLinksGetTheInertiaOfTheirGeometry) {
    const std::string text = written({{"inertial", "moving"}});
    EXPECT_EQ(text.find("<inertial><!-- foam"), text.rfind("<inertial><!-- foam")) << "base and foot do not move";
    EXPECT_THAT(text, HasSubstr("\n    " + inertial + "\n  </link>\n  <link name=\"tool\">"));
    EXPECT_THAT(text, HasSubstr("<link name=\"tool\"><inertial><mass value=\"5\"/></inertial></link>"));
    EXPECT_THAT(
        context_.said,
        ElementsAre("note: <inertial> of the collision geometry at 1000 kg/m³ is written for upper",
                    "warning: no <inertial> is written for bare, which have no collision geometry with a volume; "
                    "remedy: add <inertial> to the URDF"));
}

TEST_F(WriteUrdfExtras, AllLinksWithGeometryGetItForGazebo) {
    const std::string text = written({{"inertial", "all"}, {"density", 2000.0}});
    EXPECT_THAT(text, HasSubstr("</collision><inertial><!-- foam: collision geometry at 2000 kg/m3 --><origin xyz=\"0 "
                                "0 0\" rpy=\"0 0 0\"/><mass value=\"12000\"/>"));
    EXPECT_THAT(context_.said.front(), HasSubstr("at 2000 kg/m³ is written for base, foot, upper"));
    EXPECT_THAT(context_.said.back(), Not(HasSubstr("frame"))) << "a frame needs none";
}

TEST_F(WriteUrdfExtras, ARobotWithoutTextGetsOneWithAllThatItHas) {
    use(R"(<?xml version="1.0"?>
<robot name="a &lt;b&gt; &quot;c&quot;">
  <material name="red"><color rgba="1 0.5 0.25 1"/></material>
  <link name="base">
    <inertial><origin xyz="0 0 0.1" rpy="0 0 0.5"/><mass value="2.5"/>
      <inertia ixx="1" ixy="0.1" ixz="0.2" iyy="2" iyz="0.3" izz="2.5"/></inertial>
    <visual name="skin"><origin xyz="1 2 3"/><geometry><mesh filename="a b.stl" scale="0.001 0.002 -1"/></geometry>
      <material name="red"/></visual>
    <visual><geometry><capsule radius="0.1" length="0.3"/></geometry>
      <material name="wood"><texture filename="wood.png"/></material></visual>
    <collision name="hull"><origin xyz="0 0 1" rpy="0.3 -0.2 1"/><geometry><box size="1 2 0.3"/></geometry></collision>
  </link>
  <link name="upper"><collision><geometry><cylinder radius="0.25" length="0.7"/></geometry></collision></link>
  <link name="bare"/><link name="left"/><link name="right"/><link name="far"/>
  <joint name="lift" type="revolute"><parent link="base"/><child link="upper"/><origin xyz="0 0 0.1" rpy="1 0 0"/>
    <axis xyz="0 0.6 0.8"/><limit lower="-1" upper="2" effort="5" velocity="3"/>
    <dynamics damping="0.5" friction="0.25"/></joint>
  <joint name="weld" type="fixed"><parent link="upper"/><child link="bare"/></joint>
  <joint name="a" type="prismatic"><parent link="bare"/><child link="left"/><axis xyz="0 1 0"/>
    <limit lower="0" upper="0.04" effort="1" velocity="1"/></joint>
  <joint name="b" type="prismatic"><parent link="bare"/><child link="right"/><axis xyz="0 1 0"/>
    <limit lower="0" upper="0.04" effort="1" velocity="1"/><mimic joint="a" multiplier="-2" offset="0.01"/></joint>
  <joint name="roll" type="continuous"><parent link="right"/><child link="far"/><axis xyz="0 0 1"/></joint>
</robot>)");
    const Robot whole = *model_.robot;
    auto without_text = std::make_shared<Robot>(whole);
    without_text->source.clear();
    model_.robot = without_text;
    model_.groups = {group_of("far", {}, flat_tree({{{0, 0, 0}, 2}}))};
    use(written({{"mesh_paths", "keep"}}));
    const Robot& read = *model_.robot;
    EXPECT_EQ(read.name, whole.name);
    ASSERT_EQ(read.links.size(), whole.links.size());
    for (std::size_t i = 0; i + 1 < whole.links.size(); ++i) {
        expect_equal(read.links[i], whole.links[i]);
    }
    ASSERT_EQ(read.joints.size(), whole.joints.size());
    for (std::size_t i = 0; i < whole.joints.size(); ++i) {
        expect_equal(read.joints[i], whole.joints[i]);
    }
    EXPECT_EQ(read.links.back().collisions.size(), 1U);
}

TEST_F(WriteUrdfExtras, AMeshThatIsNotClosedIsTold) {
    Mesh open = enclosing_mesh(Element::box({1, 1, 1}));
    open.triangles.pop_back();
    model_.geometry["upper"] = Solid::make(open);
    EXPECT_THAT(written({{"inertial", "moving"}}), HasSubstr("<inertial><!-- foam"));
    EXPECT_THAT(context_.said.front(),
                HasSubstr("warning: <inertial> of the collision geometry at 1000 kg/m³ is written "
                          "for upper, whose meshes are not closed"));
    model_.geometry["upper"] = Solid::make(Mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}});
    EXPECT_THAT(written({{"inertial", "moving"}}), Not(HasSubstr("<inertial><!-- foam")));
    EXPECT_THAT(context_.said, ElementsAre(HasSubstr("no <inertial> is written for upper, bare")));
}

TEST_F(WriteUrdfExtras, KeepChangesNothing) {
    const std::string text = written({});
    EXPECT_THAT(text, Not(HasSubstr("<inertial><!-- foam")));
    EXPECT_THAT(text, Not(HasSubstr("drake")));
    EXPECT_THAT(context_.said, IsEmpty());
}

TEST_F(WriteUrdfExtras, DrakeReadsPairsAsGroupsThatExist) {
    const std::string text = written({{"drake", true}});
    EXPECT_THAT(text, testing::StartsWith("<robot xmlns:drake=\"http://drake.mit.edu\" name=\"arm\">\n"));
    EXPECT_THAT(text, testing::EndsWith(
                          "  <drake:collision_filter_group name=\"foam_base\"><drake:member link=\"base\"/>"
                          "<drake:ignored_collision_filter_group name=\"foam_upper\"/></drake:collision_filter_group>\n"
                          "  <drake:collision_filter_group name=\"foam_upper\"><drake:member link=\"upper\"/>"
                          "<drake:ignored_collision_filter_group name=\"foam_tool\"/></drake:collision_filter_group>\n"
                          "  <drake:collision_filter_group name=\"foam_tool\"><drake:member link=\"tool\"/>"
                          "</drake:collision_filter_group>\n</robot>\n"));
    model_.ignored_pairs.reset();
    EXPECT_THAT(written({{"drake", true}}), Not(HasSubstr("collision_filter_group")));
    EXPECT_THAT(context_.said, ElementsAre(HasSubstr("warning: the pairs of links that need no check are not known")));
}

TEST_F(WriteUrdfExtras, DrakesNamespaceIsDeclaredOnce) {
    const std::string declared = "<robot xmlns:drake=\"http://drake.mit.edu\" ";
    use(declared + std::string(arm + 7));
    EXPECT_EQ(written({{"drake", true}}).find("xmlns:drake", declared.size()), std::string::npos);
    use("<robot xmlns:drake=\"drake.mit.edu\" " + std::string(arm + 7));
    EXPECT_EQ(refusal(*registry_.make<Writer>("write.urdf", {{"drake", true}}), model_),
              "/none/arm.urdf:1: xmlns:drake is 'drake.mit.edu', which Drake does not read; remedy: "
              "xmlns:drake=\"http://drake.mit.edu\"");
}

TEST_F(WriteUrdfExtras, ProximityPropertiesAreThoseOfEachSphere) {
    const std::string text = written({{"drake", true}, {"mu_static", 0.5}, {"mesh_resolution_hint", 0.01}});
    const std::string properties =
        "<drake:proximity_properties><drake:mu_static value=\"0.5\"/>"
        "<drake:mesh_resolution_hint value=\"0.01\"/></drake:proximity_properties></collision>";
    std::size_t count = 0;
    for (std::size_t at = 0; (at = text.find(properties, at)) != text.npos; ++at) {
        ++count;
    }
    EXPECT_EQ(count, 3u);
    EXPECT_THAT(refusal(*registry_.make<Writer>("write.urdf", {{"mu_static", 0.5}}), model_),
                HasSubstr("remedy: drake: true"));
}

TEST(WriteUrdfPackage, PathsLeadIntoThePackageOfTheFile) {
    namespace fs = std::filesystem;
    const TemporaryFolder folder;
    const fs::path root = fs::canonical(folder.path());
    fs::create_directories(root / "ws/arm/meshes/deep");
    fs::create_directories(root / "loose");
    std::ofstream(root / "ws/arm/package.xml") << "<?xml version=\"1.0\"?>\n<package><!-- <name>no</name> -->"
                                                  "<name> arm_description\n</name></package>";
    for (const char* file : {"ws/arm/meshes/deep/a.dae", "loose/b.dae"}) {
        std::ofstream(root / file) << "x";
    }
    auto robot = std::make_shared<Robot>();
    robot->file = root / "ws/arm/arm.urdf";
    const auto text = [](const std::string& a, const std::string& b) {
        return "<robot><link name='a'><visual><geometry><mesh filename='" + a +
               "'/></geometry></visual><visual><geometry><mesh filename='" + b +
               "'/></geometry></visual><collision><origin xyz=\"0 0 0\" rpy=\"0 0 0\"/><geometry><sphere radius=\"1\"/>"
               "</geometry></collision></link></robot>";
    };
    robot->source = text("meshes/deep/a.dae", "../../loose/b.dae");
    robot->links = {{.name = "a", .collisions = {}, .visuals = {}}};
    SphereModel model = model_of(robot, {group_of("a", {}, flat_tree({{{}, 1}}))});
    model.folder = root / "out";
    Hearing context;
    const auto written = [&](const char* paths) {
        context.said.clear();
        return writer("write_urdf", "write.urdf", {{"mesh_paths", paths}})->write(model, context);
    };
    EXPECT_EQ(written("package"), text("package://arm_description/meshes/deep/a.dae", "../../loose/b.dae"));
    EXPECT_THAT(context.said, ElementsAre(HasSubstr("1 relative paths of meshes are rewritten"),
                                          "warning: 1 relative paths of meshes lead to files in no package, a folder "
                                          "with a package.xml, and are kept as they are (the first: "
                                          "'../../loose/b.dae')"));
    auto other = std::make_shared<Robot>(*robot);
    other->source = text("package://elsewhere/a.dae", "/none/b.dae");
    MeshReference mesh{"package://elsewhere/a.dae", root / "loose/b.dae", {1, 1, 1}};
    other->links[0].visuals = {{.origin = {}, .geometry = mesh, .name = {}, .line = 0}};
    model.robot = other;
    EXPECT_EQ(written("absolute"), text((root / "loose/b.dae").string(), "/none/b.dae"))
        << "a package that the loader has found";
    EXPECT_EQ(written("rewrite"), other->source);
}

} // namespace
} // namespace foam::test
