// The door between the light plugin and the heavy painter library that it opens when the first picture is wanted.
#pragma once

#include <foam/context.hpp>
#include <foam/figure.hpp>

#include <string>

namespace foam::snapshot {

/// How pictures are drawn.
struct Settings {
    double azimuth = 0;        ///< of the eye about z, from +x towards +y; radians
    double elevation = 0;      ///< of the eye above the xy plane; radians
    int supersampling = 2;     ///< samples a pixel along each side
    double mesh_opacity = 0.5; ///< of translucent meshes where nothing lies before them
    std::string font;          ///< TrueType file
};

/// Draws figures; safe to call from many threads at once.
class Painter {
public:
    virtual ~Painter() = default;
    virtual Image paint(const Figure& figure, Context& context) const = 0;
};

/// The library's only entry point, an extern "C" function of this type; the caller owns the result.
using MakePainter = Painter* (*)(const Settings& settings);
inline constexpr const char* make_painter_name = "foam_make_snapshot_painter";
/// Where the library lies, relative to the folder of the plugin.
inline constexpr const char* painter_file = "snapshot_osmesa/libfoam-snapshot-painter.so";

} // namespace foam::snapshot
