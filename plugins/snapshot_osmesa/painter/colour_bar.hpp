// The labelled colour bar of radii.
#pragma once

#include "scene.hpp"

#include <foam/sdk/context.hpp>

#include <opencv2/core.hpp>

#include <memory>
#include <string>

namespace foam::snapshot {

/// Draws text (UTF-8). Belongs to one picture; not thread-safe.
class Lettering {
public:
    virtual ~Lettering() = default;
    /// Returns the width of `text` in pixels at a font size of `size` pixels.
    virtual double width(const std::string& text, double size) = 0;
    /// Draws `text` with the left end of its base line at (x, y).
    virtual void draw(cv::Mat3b& picture, const std::string& text, double x, double y, double size,
                      cv::Vec3b colour) = 0;
};

/// Returns lettering with FreeType and the TrueType file; if that cannot be read, warns and uses OpenCV's Hershey
/// strokes.
std::unique_ptr<Lettering> make_lettering(const std::string& font, Context& context);

/// Returns `text`, or its beginning and "…", at most `room` pixels wide.
std::string fitted(Lettering& lettering, const std::string& text, double size, double room);

/// Draws bar, ticks and unit.
void draw_colour_bar(cv::Mat3b& picture, const Layout& layout, Lettering& lettering);

} // namespace foam::snapshot
