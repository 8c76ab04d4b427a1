// repair.watertight.
#pragma once

#include "rebuild.hpp"
#include "soup.hpp"

#include <foam/base/error.hpp>
#include <foam/sdk/stage.hpp>

#include <fmt/format.h>

namespace foam::repair {

/// Throws Error(internal) if the mesh is not a closed 2-manifold with a volume, which is the contract of a repair.
inline void check_promise(const Mesh& mesh, const char* stage) {
    const Topology defects = topology(mesh);
    const double volume = signed_volume(mesh);
    if (!defects.closed_manifold() || !(volume > 0)) {
        throw Error(ErrorCode::internal, fmt::format("{} made a mesh that is not closed ({}, volume {:g})", stage,
                                                     describe(defects), volume));
    }
}

class WatertightFilter final : public MeshFilter {
public:
    explicit WatertightFilter(const Parameters& parameters)
        : options_{.leaves = static_cast<std::size_t>(parameters.integer("leaves")),
                   .fill_openings = parameters.boolean("fill_openings")},
          keep_closed_(parameters.boolean("keep_closed")) {}

    Mesh apply(const Mesh& mesh, Context& context) const override {
        const Cleaned cleaned = clean(mesh, context);
        if (keep_closed_) {
            if (std::optional<Mesh> closed = sound(cleaned, {}, context)) {
                context.log(Severity::debug, "closed already: not rebuilt");
                return std::move(*closed);
            }
        }
        context.log(Severity::info, fmt::format("rebuilt ({})", describe(topology(cleaned.distinct))));
        Mesh result = rebuilt(cleaned.distinct, options_, context);
        check_promise(result, "repair.watertight");
        return result;
    }

private:
    RebuildOptions options_;
    bool keep_closed_;
};

} // namespace foam::repair
