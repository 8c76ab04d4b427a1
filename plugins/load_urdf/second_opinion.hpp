// What urdfdom, the parser of ROS, says of a model.
#pragma once

#include <xml/document.hpp>

#include <string>
#include <vector>

namespace foam::urdf {

/// urdfdom's complaints about links, joints and inertias; empty if it accepts the model. Geometry is kept from it: it
/// knows no capsules and refuses what foam can read, and foam checks geometry itself.
std::vector<std::string> complaints_of_urdfdom(std::string_view text, const xml::Element& root);

} // namespace foam::urdf
