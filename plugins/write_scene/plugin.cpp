// Spheres as objects of MoveIt's world (.scene) and as markers of ROS: write.* and read.*.
#include "scene.hpp"

#include <foam/base/error.hpp>
#include <foam/sdk/elements.hpp>
#include <foam/sdk/plugin.hpp>

namespace foam::scene {
namespace {

/// A writer that reads its files back by the reader of its format.
class BackReader : public Writer {
public:
    using Read = SphereFile (*)(const std::string& bytes);
    explicit BackReader(Read read) : read_(read) {}

    std::map<std::string, Elements>
    read(const std::string& bytes, const std::map<std::string, std::string>&) const override {
        try {
            return elements_of(read_(bytes));
        } catch (const Error& error) {
            throw Error(ErrorCode::output, error.what());
        }
    }

private:
    Read read_;
};

class SceneWriter final : public BackReader {
public:
    explicit SceneWriter(const Parameters& parameters)
        : BackReader([](const std::string& text) { return read_scene(text, "MoveIt scene"); }),
          old_format_(parameters.text("version") == "old") {}

    std::string write(const SphereModel& model, Context&) const override { return scene_text(model, old_format_); }

private:
    bool old_format_;
};

class SceneReader final : public ModelReader {
public:
    bool recognises(std::string_view text) const override { return is_scene(text); }

    SphereFile read(const std::string& text, const std::filesystem::path& file, Context&) const override {
        return read_scene(text, file);
    }
};

class MarkerWriter final : public BackReader {
public:
    explicit MarkerWriter(const Parameters& parameters)
        : BackReader([](const std::string& text) { return read_markers(text, "markers"); }),
          alpha_(parameters.number("alpha")) {}

    std::string write(const SphereModel& model, Context&) const override { return markers_text(model, alpha_); }

private:
    double alpha_;
};

class MarkerReader final : public ModelReader {
public:
    bool recognises(std::string_view text) const override { return is_markers(text); }

    SphereFile read(const std::string& text, const std::filesystem::path& file, Context&) const override {
        return read_markers(text, file);
    }
};

class CuroboSceneWriter final : public BackReader {
public:
    explicit CuroboSceneWriter(const Parameters& parameters)
        : BackReader([](const std::string& text) { return read_curobo_scene(text, "cuRobo scene"); }),
          segments_(segments_of(parameters, "write.curobo_scene")) {}

    std::string write(const SphereModel& model, Context&) const override { return curobo_scene_text(model, segments_); }

private:
    int segments_;
};

class VampWorldWriter final : public BackReader {
public:
    VampWorldWriter() : BackReader([](const std::string& text) { return read_vamp_world(text, "VAMP world"); }) {}

    std::string write(const SphereModel& model, Context&) const override { return vamp_world_text(model); }
};

/// A reader of a format that two functions know.
template <bool (*is)(std::string_view), SphereFile (*read_text)(const std::string&, const std::filesystem::path&)>
class WorldReader final : public ModelReader {
public:
    bool recognises(std::string_view text) const override { return is(text); }

    SphereFile read(const std::string& text, const std::filesystem::path& file, Context&) const override {
        return read_text(text, file);
    }
};

} // namespace
} // namespace foam::scene

namespace foam::scene {

static void add_scenes_of_ros(foam::Enrolment& enrol) {
    const std::string moveit = "https://github.com/moveit/moveit2, planning_scene.cpp: loadGeometryFromStream";
    const std::string markers = "https://docs.ros.org/en/rolling/p/visualization_msgs/msg/Marker.html";
    enrol.add<SceneWriter>(
        {.name = "write.moveit_scene",
         .summary = "Writes a scene of MoveIt: an object of the world a link, at the robot's default pose.",
         .reference = moveit,
         .parameters =
             {Parameter::choice("version", {"new", "old"}, "new")
                  .doc("old: without poses and subframes of objects, for MoveIt 1 before 1.1; for links at the "
                       "origin only.")
                  .source("MoveIt 2 writes the new format, and reads both.")},
         .extensions = {"scene"},
         .kinds = foam::every_kind(),
         .consumer = {.name = "MoveIt 2 (8fcb5d2327)", .rest_pose = true}});
    enrol.add<SceneReader>(
        {.name = "read.moveit_scene",
         .summary = "Reads the shapes of a scene of MoveIt that are convex elements, old or new format, by object.",
         .reference = moveit,
         .extensions = {"scene"}});
    enrol.add<MarkerWriter>(
        {.name = "write.markers",
         .summary = "Writes a MarkerArray of ROS as YAML: a marker an element, in link frames; a capsule is three.",
         .reference = markers,
         .parameters = {Parameter::number("alpha", 0.6)
                            .bounds(0.01, 1)
                            .unit("1")
                            .doc("Opacity of the markers.")
                            .source("The robot shows through.")},
         .extensions = {"yaml", "yml"},
         .kinds = foam::every_kind(),
         .consumer = {.name = "visualization_msgs/MarkerArray (ROS 1 and 2)"}});
    enrol.add<MarkerReader>(
        {.name = "read.markers",
         .summary = "Reads the markers of a MarkerArray of ROS as YAML that are convex elements, by frame.",
         .reference = markers,
         .extensions = {"yaml", "yml"}});
}

static void add_worlds_of_planners(foam::Enrolment& enrol) {
    const std::string curobo = "https://github.com/NVlabs/curobo, curobo/_src/geom/types.py";
    const std::string vamp = "https://github.com/KavrakiLab/vamp, src/vamp/__init__.py: problem_dict_to_vamp";
    enrol.add<CuroboSceneWriter>(
        {.name = "write.curobo_scene",
         .summary =
             "Writes obstacles of one frame as a scene of cuRobo: spheres, cuboids, and meshes that enclose all else.",
         .reference = curobo,
         .parameters = {foam::segments_parameter()},
         .extensions = {"yml", "yaml"},
         .kinds = foam::every_kind(),
         .consumer = {.name = "cuRobo 0.7 and 0.8 (a35a708ecf)", .float32 = true}});
    enrol.add<WorldReader<is_curobo_scene, read_curobo_scene>>(
        {.name = "read.curobo_scene",
         .summary = "Reads spheres, cuboids and convex meshes of a scene of cuRobo.",
         .reference = curobo,
         .extensions = {"yml", "yaml"}});
    enrol.add<VampWorldWriter>(
        {.name = "write.vamp_world",
         .summary = "Writes obstacles of one frame as a problem of VAMP: spheres, boxes and capsules, which a cylinder "
                    "becomes.",
         .reference = vamp,
         .extensions = {"json"},
         .kinds = {foam::Element::Kind::sphere, foam::Element::Kind::capsule, foam::Element::Kind::cylinder,
                   foam::Element::Kind::box},
         .consumer = {.name = "VAMP (3141841915)", .float32 = true}});
    enrol.add<WorldReader<is_vamp_world, read_vamp_world>>(
        {.name = "read.vamp_world",
         .summary = "Reads the spheres, capsules and boxes of a problem of VAMP.",
         .reference = vamp,
         .extensions = {"json"}});
}

} // namespace foam::scene

FOAM_PLUGIN("write_scene", "1.0", "Apache-2.0") {
    foam::scene::add_scenes_of_ros(enrol);
    foam::scene::add_worlds_of_planners(enrol);
}
