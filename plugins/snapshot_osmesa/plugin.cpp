// snapshot.osmesa: the stage. The drawing is in painter/, a library that is opened for the first picture, because its
// dependencies would slow down every start of the program tenfold.
#include "painter.hpp"

#include <foam/sdk/late_library.hpp>
#include <foam/sdk/plugin.hpp>

#include <memory>
#include <mutex>
#include <numbers>

namespace foam::snapshot {
namespace {

/// Opens the painter library beside this plugin.
MakePainter load_painter() {
    const LateLibrary library{.stage = "snapshot.osmesa",
                              .file = painter_file,
                              .entry = make_painter_name,
                              .cure = "install the packages listed for snapshots in dependencies.txt"};
    return reinterpret_cast<MakePainter>(open_late_library(library, reinterpret_cast<const void*>(&load_painter)));
}

class OsmesaSnapshot final : public Renderer {
public:
    explicit OsmesaSnapshot(const Parameters& parameters) {
        constexpr double degree = std::numbers::pi / 180;
        settings_.azimuth = parameters.number("azimuth") * degree;
        settings_.elevation = parameters.number("elevation") * degree;
        settings_.supersampling = static_cast<int>(parameters.integer("supersampling"));
        settings_.mesh_opacity = parameters.number("mesh_opacity");
        settings_.turntable = parameters.boolean("turntable");
        settings_.font = parameters.text("font");
    }

    Image render(const Figure& figure, Context& context) const override { return painter().paint(figure, context); }

private:
    const Painter& painter() const {
        const std::lock_guard lock(mutex_);
        if (!painter_) {
            painter_.reset(load_painter()(settings_));
        }
        return *painter_;
    }

    Settings settings_;
    mutable std::mutex mutex_;
    mutable std::unique_ptr<Painter> painter_; // made by the first render()
};

} // namespace
} // namespace foam::snapshot

FOAM_PLUGIN("snapshot_osmesa", "1.0", "Apache-2.0") {
    using foam::Parameter;
    enrol.add<foam::snapshot::OsmesaSnapshot>({
        .name = "snapshot.osmesa",
        .summary =
            "Draws meshes and spheres off-screen, spheres coloured by radius with a labelled colour bar, as a PNG",
        .reference = "Mesa off-screen rendering (OSMesa), OpenGL 3.3 core profile",
        .parameters =
            {Parameter::number("azimuth", -55)
                 .unit("deg")
                 .bounds(-360, 360)
                 .doc("Direction of the eye about the z axis, from +x towards +y.")
                 .source("three-quarter view with x to the right, as robots are usually pictured"),
             Parameter::number("elevation", 20)
                 .unit("deg")
                 .bounds(-90, 90)
                 .doc("Height of the eye above the horizontal.")
                 .source("three-quarter view, as robots are usually pictured"),
             Parameter::integer("supersampling", 2)
                 .unit("1")
                 .bounds(1, 4)
                 .doc("Samples a pixel along each side of it; their mean is the pixel.")
                 .source("4 samples a pixel, the usual count of multisampling hardware"),
             Parameter::number("mesh_opacity", 0.5)
                 .unit("1")
                 .bounds(0, 1)
                 .doc("Opacity of translucent meshes where nothing lies before them; inside spheres they are fainter.")
                 .source("chosen by eye on the Panda's links"),
             Parameter::boolean("turntable", false)
                 .doc("Scales and places views so that they fit from every azimuth: the frames of a turntable."),
             Parameter::text("font", "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf")
                 .doc("TrueType file of all texts; if it cannot be read, OpenCV's Hershey strokes serve.")
                 .source("Debian package fonts-dejavu-core")},
        .extensions = {},
    });
}
