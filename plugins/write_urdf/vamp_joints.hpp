// The joints of a robot as cricket, VAMP's compiler, plans them: each one that is not fixed is a dimension.
#pragma once

#include "sphere_urdf.hpp"

namespace foam {

/// Turns locked joints, what mimics them, and planar and floating joints to fixed ones where they stand; continuous
/// joints to revolute ones from -π to π. Throws Error(output) for a joint that mimics one that is planned, and if no
/// joint is left to plan.
void fix_joints(SphereUrdf& urdf, Context& context);

} // namespace foam
