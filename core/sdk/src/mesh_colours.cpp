#include <foam/sdk/mesh_colours.hpp>

namespace foam::inline sdk {

MeshColours::MeshColours() = default;
MeshColours::~MeshColours() = default;

} // namespace foam::inline sdk
