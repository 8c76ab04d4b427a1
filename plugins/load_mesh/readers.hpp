// The formats: each reader adds the file's faces to the builder or throws Error(input).
#pragma once

#include "builder.hpp"
#include "text.hpp"

namespace foam::load_mesh {

/// STL, binary or text. Binary coordinates are 32-bit, so nothing is lost in either.
void read_stl(const Source& source, MeshBuilder& builder, Context& context);
/// Wavefront OBJ: polygons; free-form surfaces, lines and points are left out, which is logged.
void read_obj(const Source& source, MeshBuilder& builder, Context& context);
/// Geomview OFF as text, with any of the prefixes C, N and ST.
void read_off(const Source& source, MeshBuilder& builder, Context& context);
/// PLY 1.0: text, little and big endian; polygons and triangle strips.
void read_ply(const Source& source, MeshBuilder& builder, Context& context);

/// COLLADA 1.4 and 1.5: the scene, unit applied, up-axis ignored.
void read_collada(const Source& source, MeshBuilder& builder, Context& context);
/// glTF 2.0 or GLB: the scene.
void read_gltf(const Source& source, MeshBuilder& builder, Context& context);

/// The reader that the file's ending names; throws for other endings.
void read_any(const Source& source, MeshBuilder& builder, Context& context);

} // namespace foam::load_mesh
