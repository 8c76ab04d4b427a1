// What a model does in poses, for the terminal.
#pragma once

#include <foam/collision/consequences.hpp>

#include <string>

namespace foam::cli {

/// Returns the counts of poses, and the pairs and elements with most false or missed contacts.
std::string poses_text(const Robot& robot, const Consequences& found);

} // namespace foam::cli
