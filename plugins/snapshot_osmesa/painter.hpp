// The interface between the light plugin and the heavy painter library, which is opened for the first picture.
#pragma once

#include <foam/geometry/figure.hpp>
#include <foam/sdk/context.hpp>

#include <string>

namespace foam::snapshot {

/// The settings of pictures.
struct Settings {
    double azimuth = 0;        ///< of the eye about z, from +x towards +y; radians
    double elevation = 0;      ///< of the eye above the xy plane; radians
    int supersampling = 2;     ///< samples per pixel along each side
    bool turntable = false;    ///< leaves room for the view from every azimuth
    double mesh_opacity = 0.5; ///< of translucent meshes where nothing is in front of them
    std::string font;          ///< TrueType file
};

/// Draws figures. Safe to call from many threads at once.
class Painter {
public:
    virtual ~Painter() = default;
    virtual Image paint(const Figure& figure, Context& context) const = 0;
};

/// The library's only entry point, an extern "C" function of this type. The caller owns the result.
using MakePainter = Painter* (*)(const Settings& settings);
inline constexpr const char* make_painter_name = "foam_make_snapshot_painter";
/// The place of the library relative to the plugin's folder.
inline constexpr const char* painter_file = "snapshot_osmesa/libfoam-snapshot-painter.so";

} // namespace foam::snapshot
