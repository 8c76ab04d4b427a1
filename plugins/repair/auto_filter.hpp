// repair.auto.
#pragma once

#include "watertight_filter.hpp"

#include <foam/self_intersection.hpp>

namespace foam::repair {

class AutoFilter final : public MeshFilter {
public:
    explicit AutoFilter(const Parameters& parameters)
        : soup_{.seam = parameters.number("seam"), .largest_hole = parameters.number("largest_hole")},
          leaves_(static_cast<std::size_t>(parameters.integer("leaves"))) {}

    Mesh apply(const Mesh& mesh, Context& context) const override {
        const Cleaned cleaned = clean(mesh, context);
        if (std::optional<Mesh> result = mended(cleaned, soup_, context)) {
            context.log(Severity::debug, "taken: repair.soup, the lightest repair whose result is a solid");
            return std::move(*result);
        }
        const std::string defects = describe(topology(cleaned.distinct));
        std::string trouble;
        for (const std::size_t finer : {1, 8, 64}) {
            try {
                Mesh result = rebuilt(cleaned.distinct, {.leaves = finer * leaves_, .fill_openings = true}, context);
                check_promise(result, "repair.watertight");
                if (self_intersections(result).empty()) {
                    context.log(
                        Severity::info,
                        fmt::format("taken: repair.watertight with {} leaves; mending in place was not enough ({})",
                                    finer * leaves_, defects));
                    return result;
                }
                trouble = "triangles of the rebuilt surface pass through each other";
            } catch (const Error& error) {
                if (error.code() == ErrorCode::cancelled) {
                    throw;
                }
                trouble = error.what();
            }
        }
        throw Error(ErrorCode::geometry,
                    fmt::format("no repair gave a solid ({}): {}; remedy: repair.wrap, or mend the "
                                "mesh by hand",
                                defects, trouble));
    }

private:
    SoupOptions soup_;
    std::size_t leaves_;
};

} // namespace foam::repair
