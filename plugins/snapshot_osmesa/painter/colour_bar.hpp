// The labelled colour bar of radii.
#pragma once

#include "layout.hpp"
#include "text.hpp"

namespace foam::snapshot {

/// Draws bar, ticks and unit.
void draw_colour_bar(cv::Mat3b& picture, const Layout& layout, Lettering& lettering);

} // namespace foam::snapshot
