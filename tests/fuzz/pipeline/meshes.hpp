// Small meshes of every kind of trouble.
#pragma once

#include "dice.hpp"

#include <foam/geometry/mesh.hpp>

namespace foam::fuzz {

/// 1 to about 300 triangles. Most are ordinary bodies of ordinary sizes, some of them damaged; others are degenerate,
/// or have odd numbers.
Mesh random_mesh(Dice& dice, bool odd_numbers);

/// The mesh as a file: "obj", "stl" (ASCII), "stlb" (binary; single precision), "off" or "ply".
std::string mesh_file(const Mesh& mesh, const std::string& format);
/// Which of them; obj and the two kinds of STL, which the judge reads, most often.
std::string random_format(Dice& dice);
/// The ending of a format's files.
std::string ending_of(const std::string& format);

} // namespace foam::fuzz
