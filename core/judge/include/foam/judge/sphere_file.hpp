// Sphere models in the file formats of many programs, read by the registry's model readers.
#pragma once

#include <foam/sdk/model.hpp>
#include <foam/sdk/registry.hpp>

#include <filesystem>
#include <string>

namespace foam {
inline namespace [[gnu::visibility("default")]] judge {

/// The radii of a file in which a buffer (cuRobo, XRDF) is added to them.
enum class Radii {
    as_used,    ///< with the buffer, as the program has them that uses the file
    as_written, ///< without
};

/// Reads a sphere model with the model reader that recognises it, or with `reader` ("read.curobo") if that is not
/// empty. Spheres whose radius is not above 0 are switched off (cuMotion): they are left out, with a note. Throws
/// Error(input) naming file, line and remedy: also if no reader recognises the file, or several do; Error(usage) for an
/// unknown reader. `name`: that its content goes by, as in parse_sphere_file(); empty: the file's own.
SphereFile read_sphere_file(const std::filesystem::path& file, const Registry& registry, const std::string& reader = "",
                            Radii radii = Radii::as_used, const std::filesystem::path& name = {});

/// Reads a sphere model from memory; `file`: its name in messages, and the base of relative references.
SphereFile parse_sphere_file(const std::string& text, const std::filesystem::path& file, const Registry& registry,
                             const std::string& reader = "", Radii radii = Radii::as_used);

} // namespace judge
} // namespace foam
