// The check of a model by urdfdom, the parser of ROS.
#pragma once

#include <foam/xml/document.hpp>

#include <string>
#include <vector>

namespace foam::urdf {

/// Returns urdfdom's messages on links, joints and inertias; empty if it accepts the model. It does not get the
/// geometry: it does not support capsules and refuses geometry that foam reads, and foam checks geometry itself.
std::vector<std::string> complaints_of_urdfdom(std::string_view text, const xml::Element& root);

} // namespace foam::urdf
