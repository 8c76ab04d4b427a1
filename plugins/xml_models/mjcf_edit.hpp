// Spheres into an MJCF file of the user.
#pragma once

#include <foam/sdk/model.hpp>
#include <foam/sdk/stage.hpp>
#include <foam/sdk/writing.hpp>

#include <optional>
#include <string>
#include <vector>

namespace foam::xml_models {

struct MjcfReplacement {
    bool all_collision = false;                         ///< also other geoms with contact than spheres
    PairEdit pairs = PairEdit::keep;                    ///< what happens to the <exclude> elements
    std::optional<std::vector<IgnoredPair>> found = {}; ///< SphereModel::ignored_pairs
};

/// Returns the file with the spheres of the bodies called like the links replaced; every other byte stays. New geoms
/// take over the class of the first one that they replace. Throws Error(input) if the file is not MJCF or lacks a body.
std::string with_spheres(const TextFile& into, const std::vector<LinkSpheres>& links, const MjcfReplacement& what,
                         Context& context);

/// Returns ` <exclude body1=… body2=…/>` of a pair, without the blank.
std::string exclude_text(const IgnoredPair& pair);

} // namespace foam::xml_models
