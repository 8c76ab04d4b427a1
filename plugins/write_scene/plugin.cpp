// Spheres as objects of MoveIt's world (.scene) and as markers of ROS: write.* and read.*.
#include "markers.hpp"
#include "scene.hpp"

#include <foam/base/error.hpp>
#include <foam/sdk/plugin.hpp>

namespace foam::scene {
namespace {

/// Returns the spheres by link of a file that the same program wrote.
template <class Read> std::map<std::string, std::vector<Sphere>> read_back(const Read& read, const std::string& bytes) {
    std::map<std::string, std::vector<Sphere>> result;
    try {
        for (LinkSpheres& link : read(bytes).links) {
            result[link.link] = std::move(link.spheres);
        }
    } catch (const Error& error) {
        throw Error(ErrorCode::output, error.what());
    }
    return result;
}

class SceneWriter final : public Writer {
public:
    explicit SceneWriter(const Parameters& parameters) : old_format_(parameters.text("version") == "old") {}

    std::string write(const SphereModel& model, Context&) const override { return scene_text(model, old_format_); }

    std::map<std::string, std::vector<Sphere>> read(const std::string& bytes) const override {
        return read_back([](const std::string& text) { return read_scene(text, "MoveIt scene"); }, bytes);
    }

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

class MarkerWriter final : public Writer {
public:
    explicit MarkerWriter(const Parameters& parameters) : alpha_(parameters.number("alpha")) {}

    std::string write(const SphereModel& model, Context&) const override { return markers_text(model, alpha_); }

    std::map<std::string, std::vector<Sphere>> read(const std::string& bytes) const override {
        return read_back([](const std::string& text) { return read_markers(text, "markers"); }, bytes);
    }

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

} // namespace
} // namespace foam::scene

FOAM_PLUGIN("write_scene", "1.0", "Apache-2.0") {
    using namespace foam::scene;
    using foam::Parameter;
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
         .consumer = {.name = "MoveIt 2 (8fcb5d2327)"}});
    enrol.add<SceneReader>({.name = "read.moveit_scene",
                            .summary = "Reads the spheres of a scene of MoveIt, old or new format, by object.",
                            .reference = moveit,
                            .extensions = {"scene"}});
    enrol.add<MarkerWriter>(
        {.name = "write.markers",
         .summary = "Writes a MarkerArray of ROS as YAML: a sphere marker a sphere, in link frames.",
         .reference = markers,
         .parameters = {Parameter::number("alpha", 0.6)
                            .bounds(0.01, 1)
                            .unit("1")
                            .doc("Opacity of the markers.")
                            .source("The robot shows through.")},
         .extensions = {"yaml", "yml"},
         .consumer = {.name = "visualization_msgs/MarkerArray (ROS 1 and 2)"}});
    enrol.add<MarkerReader>({.name = "read.markers",
                             .summary = "Reads the sphere markers of a MarkerArray of ROS as YAML, by frame.",
                             .reference = markers,
                             .extensions = {"yaml", "yml"}});
}
