// The painter's shader programs, GLSL 3.30.
#pragma once

namespace foam::snapshot::shaders {

extern const char* const prelude;          ///< the beginning of each: version, and light on a surface
extern const char* const facet_vertex;     ///< triangles, flat
extern const char* const facet_fragment;   ///< opaque triangles with their edges
extern const char* const glass_fragment;   ///< translucent triangles: normals only, shaded by compose_fragment
extern const char* const ball_vertex;      ///< one square per sphere
extern const char* const ball_fragment;    ///< exact spheres
extern const char* const compose_vertex;   ///< one triangle over the whole picture
extern const char* const compose_fragment; ///< layers, outlines and the mean over a pixel's samples

} // namespace foam::snapshot::shaders
