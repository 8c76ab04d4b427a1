// repair.soup.
#pragma once

#include "soup.hpp"

#include <foam/error.hpp>
#include <foam/stage.hpp>

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
        throw Error(ErrorCode::geometry,
                    fmt::format("the mesh is too broken to be mended in place ({}); remedy: repair.auto or "
                                "repair.watertight, which rebuild the surface",
                                describe(topology(cleaned.distinct))));
    }

private:
    SoupOptions options_;
};

} // namespace foam::repair
