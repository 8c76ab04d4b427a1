// The last stages of each link: growth, proof, measures.
#pragma once

#include <foam/runtime/internal/spherize.hpp>
#include <foam/sdk/model.hpp>

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] runtime {

/// A finished link: its original geometry, in the link's frame, and its elements.
struct FinishedLink {
    const LinkWork* work = nullptr;
    std::shared_ptr<const Solid> solid;
    Elements elements; ///< of all its groups, finest level; without parents
};

struct FinishedModel {
    SphereModel model;
    std::vector<FinishedLink> links;
};

/// Returns the original geometry of some elements of a link, in the link's frame.
std::shared_ptr<const Solid> solid_of(const LoadedLink& link, const std::vector<std::size_t>& elements);
/// Returns the original geometry of all elements. Precondition: its meshes are loaded.
std::shared_ptr<const Solid> solid_of(const LoadedLink& link);

/// Returns the geometry of all elements as solid_of() does, as geometry::quick_solid(): proofs need no more.
std::shared_ptr<const Solid> quick_solid_of(const LoadedLink& link);

/// Returns about the smallest enclosing sphere of a solid, large enough that rounding its centre leaves nothing out:
/// growth, which would search for its least radius, leaves it as it is.
Sphere enclosing_ball(const Solid& solid);

/// Grows the spheres as the guarantee requires, proves it, measures them. Fills in the link reports.
FinishedModel finish_links(const Workspace& workspace, std::shared_ptr<const Robot> robot, std::vector<LinkWork>& links,
                           std::vector<Group> groups);

/// Handles links that failed: `stop` throws the first error; `skip` keeps their geometry; `fallback` gives them one
/// enclosing sphere of their vertices, if they could be loaded. Returns true if a link has no spheres as a result.
bool handle_errors(const Workspace& workspace, std::vector<LinkWork>& links, std::vector<Group>& groups);

} // namespace runtime
} // namespace foam
