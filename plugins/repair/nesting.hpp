// The orientation of the closed parts of a mesh.
#pragma once

#include "fans.hpp"

namespace foam::repair {

struct NestingReport {
    std::size_t turned = 0;   ///< components that were turned inside out
    std::size_t cavities = 0; ///< components that face inwards and stay so
    bool hollow = false;      ///< a component has no volume: the mesh does not bound a solid
};

/// Turns closed, oriented components so that together they bound a solid. Outermost components face outwards; the
/// components inside are turned with them. Inner components may face inwards (cavities) only inside of one that faces
/// outwards. Components in `mixed` have no reliable orientation and face outwards.
NestingReport orient_components(Mesh& mesh, const Components& components, const std::vector<char>& mixed);

} // namespace foam::repair
