// Which way the closed parts of a mesh should face.
#pragma once

#include "fans.hpp"

namespace foam::repair {

struct NestingReport {
    std::size_t turned = 0;   ///< components that were turned inside out
    std::size_t cavities = 0; ///< components that face inwards and are left so
    bool hollow = false;      ///< a component has no volume: the mesh does not bound a solid
};

/// Turns closed, oriented components so that together they bound a solid: outermost ones face outwards (what they hold
/// is turned with them), inner ones may face inwards (cavities) only inside of one that faces outwards. Components in
/// `mixed` have no trustworthy direction of their own and face outwards.
NestingReport orient_components(Mesh& mesh, const Components& components, const std::vector<char>& mixed);

} // namespace foam::repair
