// Collision elements of a URDF.
#pragma once

#include "xml.hpp"

#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace judge {

struct LinkCollisions {
    std::string link;
    std::vector<Element> collisions; ///< the <collision> elements, at least one
};

/// By link, in the order of the file; not those of the links `without`. Throws std::runtime_error.
std::vector<LinkCollisions> collisions_of(const std::filesystem::path& file, const std::set<std::string>& without = {});

/// The file that a reference leads to. "package://NAME/REST" lies in a folder NAME around the URDF, or in the folder
/// NAME of one of those; some files mean a path from a folder around the URDF. Throws std::runtime_error.
std::filesystem::path resolved(const std::string& reference, const std::filesystem::path& folder);

} // namespace judge
