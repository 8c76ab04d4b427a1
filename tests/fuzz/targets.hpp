// What the fuzzers call: one function for each format that foam reads.
#pragma once

#include <span>
#include <string_view>

namespace foam::fuzz {

/// Reads the bytes as a file of that format. Whatever they are, they are read or refused with an Error that names file
/// and reason; throws anything else when that promise, or one about what was read, is broken.
using Target = void (*)(std::string_view bytes);

struct NamedTarget {
    std::string_view name;
    Target run;
};

std::span<const NamedTarget> targets();
/// nullptr if there is none of that name.
Target find_target(std::string_view name);

void read_stl(std::string_view bytes);
void read_obj(std::string_view bytes);
void read_off(std::string_view bytes);
void read_ply(std::string_view bytes);
void read_dae(std::string_view bytes);
void read_gltf(std::string_view bytes);
void read_urdf(std::string_view bytes);
void read_spheres(std::string_view bytes);
void read_recipe(std::string_view bytes);

} // namespace foam::fuzz
