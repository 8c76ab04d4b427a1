// The end of the line for each link: cover, proof, measures.
#pragma once

#include "spherize.hpp"

#include <foam/model.hpp>

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace foam {

/// A finished link: its geometry as the URDF gives it, in the link's frame, beside its spheres.
struct FinishedLink {
    const LinkWork* work = nullptr;
    std::shared_ptr<const Solid> solid;
    std::vector<Sphere> spheres; ///< of all its groups, finest level
};

struct FinishedModel {
    SphereModel model;
    std::vector<FinishedLink> links;
};

/// The geometry of some elements of a link as the URDF gives it, in the link's frame.
std::shared_ptr<const Solid> solid_of(const LinkWork& link, const std::vector<std::size_t>& elements);
/// Of all its elements. Its meshes are loaded.
std::shared_ptr<const Solid> solid_of(const LinkWork& link);

/// Grows what the guarantee asks for, proves it, measures it. Link reports are filled in.
FinishedModel finish_links(const Workspace& workspace, std::shared_ptr<const Robot> robot, std::vector<LinkWork>& links,
                           std::vector<Group> groups);

/// Deals with links that failed: stop throws the first error; skip leaves their geometry as it was; fallback gives them
/// one enclosing sphere of their vertices, if they could be loaded. Returns true if a link was lost.
bool handle_errors(const Workspace& workspace, std::vector<LinkWork>& links, std::vector<Group>& groups);

} // namespace foam
