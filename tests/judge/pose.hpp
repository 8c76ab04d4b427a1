// Poses as URDF writes them.
#pragma once

#include "body.hpp"
#include "xml.hpp"

#include <string>

namespace judge {

/// Three numbers; `otherwise` if the text is empty. Throws std::runtime_error.
Point vector_of(const std::string& text, const Point& otherwise);
/// The frame of <origin>: turned about x, then y, then z of the link (URDF: fixed-axis roll, pitch, yaw).
Placement placement_of(const Element& element);
/// What doubles lose when a point p of size |p| is scaled, turned and moved.
Real placement_error(const Placement& place, bool scaled, Real size);

} // namespace judge
