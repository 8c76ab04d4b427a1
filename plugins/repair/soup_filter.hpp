// repair.soup.
#pragma once

#include "soup.hpp"

#include <foam/base/error.hpp>
#include <foam/sdk/stage.hpp>

#include <fmt/format.h>

namespace foam::repair {

class SoupFilter final : public MeshFilter {
public:
    explicit SoupFilter(const Parameters& parameters)
        : options_{.seam = parameters.number("seam"), .largest_hole = parameters.number("largest_hole")} {}

    Mesh apply(const Mesh& mesh, Context& context) const override {
        const Cleaned cleaned = clean(mesh, context);
        if (std::optional<Mesh> result = mended(cleaned, options_, context)) {
            return std::move(*result);
        }
        const Topology defects = topology(cleaned.distinct);
        throw Error(ErrorCode::geometry,
                    fmt::format("the mesh is too broken to be mended in place ({}); remedy: repair.auto or "
                                "repair.watertight, which rebuild the surface",
                                defects.closed_manifold()
                                    ? "closed, but too thin for its volume to be told from rounding"
                                    : describe(defects)));
    }

private:
    SoupOptions options_;
};

} // namespace foam::repair
