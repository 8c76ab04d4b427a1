// Readers of the formats: each adds the file's faces to the builder or throws Error(input).
#pragma once

#include "builder.hpp"
#include "text.hpp"

#include <cstdint>
#include <functional>
#include <map>
#include <string>

namespace foam::load_mesh {

/// Reads STL, binary or text. Binary coordinates are 32-bit, so neither loses digits.
void read_stl(const Source& source, MeshBuilder& builder, Context& context);
/// Reads polygons of Wavefront OBJ. Leaves out free-form surfaces, lines and points, with a log message.
void read_obj(const Source& source, MeshBuilder& builder, Context& context);
/// Reads Geomview OFF as text, with any of the prefixes C, N and ST.
void read_off(const Source& source, MeshBuilder& builder, Context& context);
/// Reads PLY 1.0: text, little and big endian; polygons and triangle strips.
void read_ply(const Source& source, MeshBuilder& builder, Context& context);

/// Reads the scene of COLLADA 1.4 and 1.5; the unit is applied, the up-axis is ignored.
void read_collada(const Source& source, MeshBuilder& builder, Context& context);
/// Reads the scene of glTF 2.0 or GLB.
void read_gltf(const Source& source, MeshBuilder& builder, Context& context);

/// Calls the reader for the file's extension. Throws for other extensions.
void read_any(const Source& source, MeshBuilder& builder, Context& context);

/// Returns the diffuse colours (Kd, d), 0xRRGGBBAA, of the materials in the files that an OBJ names in its folder; none
/// of a file that cannot be read.
std::map<std::string, std::uint32_t, std::less<>> obj_colours(const Source& obj);

} // namespace foam::load_mesh
