// load.mesh: from a mesh file to a Mesh.
//
// Each format has its own reader. Readers calculate in double precision, so that a part far from its origin keeps its
// shape. They trust no count or index of the file, and name the place of an error.
//
// A mesh has every triangle of the file, also degenerate ones, in the order of the file. Vertices with identical
// coordinates become one. Normals and texture coordinates are left out; colours are for pictures only (MeshColours).
#pragma once

#include "builder.hpp"

#include <foam/sdk/context.hpp>
#include <foam/sdk/stage.hpp>

namespace foam::load_mesh {

class Loader final : public MeshLoader, public MeshColours {
public:
    explicit Loader(const Parameters& parameters);
    Mesh load(const std::filesystem::path& file, Context& context) const override;
    std::vector<std::uint32_t> colours(const std::filesystem::path& file, Context& context) const override;

private:
    Source source_of(const std::filesystem::path& file) const;

    Limits limits_;
};

} // namespace foam::load_mesh
