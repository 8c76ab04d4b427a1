// <inertial> of links that lack it, for programs that drop such links, or invent a mass for them.
#pragma once

#include "sphere_urdf.hpp"

namespace foam {

/// The links that get an <inertial> if they lack it.
enum class InertialOf {
    none,
    moving, ///< those between which and the root a joint moves
    all,    ///< Gazebo drops every link without
};

/// Adds the mass, centre and inertia of the original collision geometry at a density, kg/m³. Logs which links got one,
/// and which did not.
void add_inertials(SphereUrdf& urdf, InertialOf which, double density, Context& context);

} // namespace foam
