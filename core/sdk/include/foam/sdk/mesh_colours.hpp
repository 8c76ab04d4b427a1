// Colours of meshes, for pictures: what a mesh loader can offer beyond the geometry.
#pragma once

#include <foam/sdk/context.hpp>

#include <cstdint>
#include <filesystem>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] sdk {

/// A base class of mesh loaders that know the colours of triangles, beside MeshLoader.
class MeshColours {
public:
    virtual ~MeshColours();
    MeshColours(const MeshColours&) = delete;
    MeshColours& operator=(const MeshColours&) = delete;
    /// Returns a colour 0xRRGGBBAA for each triangle of load(), in its order; 0 where the file has none, or only a
    /// texture. Empty: the file has no colours. Throws as load() does.
    virtual std::vector<std::uint32_t> colours(const std::filesystem::path& file, Context& context) const = 0;

protected:
    MeshColours();
};

} // namespace sdk
} // namespace foam
