// repair.auto.
#pragma once

#include "watertight_filter.hpp"

#include <foam/geometry/mesh_checks.hpp>
#include <foam/sdk/plugin.hpp>

#include <memory>

namespace foam::repair {

class AutoFilter final : public MeshFilter {
public:
    AutoFilter(const Parameters& parameters, const StageMaker& maker)
        : soup_{.seam = parameters.number("seam"), .largest_hole = parameters.number("largest_hole")},
          leaves_(static_cast<std::size_t>(parameters.integer("leaves"))),
          wrap_(maker.make<MeshFilter>("repair.wrap")) {}

    Mesh apply(const Mesh& mesh, Context& context) const override {
        const Cleaned cleaned = clean(mesh, context);
        if (std::optional<Mesh> result = mended(cleaned, soup_, context)) {
            context.log(Severity::debug, "taken: repair.soup, the lightest repair whose result is a solid");
            return std::move(*result);
        }
        std::string trouble;
        for (const std::size_t leaves : {leaves_, 8 * leaves_, 64 * leaves_}) {
            if (std::optional<Mesh> result = watertight(cleaned.distinct, leaves, trouble, context)) {
                return std::move(*result);
            }
        }
        if (wrap_) {
            Mesh result = wrap_->apply(mesh, context);
            context.log(Severity::info, fmt::format("taken: repair.wrap; repair.watertight failed: {}", trouble));
            return result;
        }
        throw Error(ErrorCode::geometry,
                    fmt::format("no repair gave a solid ({}): {}; remedy: install the plugin with repair.wrap, or mend "
                                "the mesh by hand",
                                describe(topology(cleaned.distinct)), trouble));
    }

private:
    /// Returns nothing if the result does not meet the requirements; `trouble` is then the reason.
    static std::optional<Mesh> watertight(const Mesh& mesh, std::size_t leaves, std::string& trouble,
                                          Context& context) {
        try {
            Mesh result = rebuilt(mesh, {.leaves = leaves, .fill_openings = true}, context);
            check_promise(result, "repair.watertight");
            if (self_intersections(result).empty()) {
                context.log(Severity::info,
                            fmt::format("taken: repair.watertight with {} leaves; mending in place was not enough ({})",
                                        leaves, describe(topology(mesh))));
                return result;
            }
            trouble = "triangles of the rebuilt surface pass through each other";
        } catch (const Error& error) {
            if (error.code() == ErrorCode::cancelled) {
                throw;
            }
            trouble = error.what();
        }
        return std::nullopt;
    }

    SoupOptions soup_;
    std::size_t leaves_;
    std::unique_ptr<MeshFilter> wrap_; ///< null without the GPL plugin
};

} // namespace foam::repair
