// Elements that share a surface: less volume of their union outside the solid.
#pragma once

#include "cover/measured/occupancy.hpp"
#include "cells.hpp"
#include "cloud.hpp"

#include <foam/search/spherize.hpp>

#include <vector>

namespace foam::inline search::convex {

/// Makes the volume of the union outside the solid less, while the union goes on to hold the surface. In turn each
/// element gives up what others hold: it moves, turns and changes its lengths by steps that reduce its own share of the
/// volume outside, with the points that no other element holds as constraints. The slopes of that share are integrals
/// over the part of the element's boundary that lies outside the solid and the others, and the steps those of a
/// sequence of quadratic programmes. Elements that hold nothing alone are dropped. Precondition: no hulls; the fits in
/// the frame of the body hold its surface.
std::vector<Fit> descended_together(const Body& body, const cover::Occupancy& occupancy, std::vector<Fit> fits,
                                    Effort effort, bool keep_axes);

} // namespace foam::inline search::convex
