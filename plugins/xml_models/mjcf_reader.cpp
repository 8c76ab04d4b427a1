// The elements of MJCF: geoms of bodies that take part in contacts.
#include "mjcf.hpp"
#include "mjcf_geoms.hpp"

#include <foam/base/error.hpp>

#include <fmt/format.h>

#include <set>

namespace foam::xml_models {

bool MjcfReader::recognises(std::string_view text) const {
    return xml::root_name(text) == "mujoco";
}

SphereFile MjcfReader::read(const std::string& text, const std::filesystem::path& file, Context&) const {
    const auto root = xml::parse(text, file.string(), ErrorCode::input);
    SphereFile result;
    result.file = file;
    result.format = "MJCF";
    if (root->name != "mujoco") {
        throw Error(ErrorCode::input,
                    fmt::format("{}:{}: <{}> is not <mujoco>", file.string(), root->line, root->name));
    }
    const MjcfElements elements(*root, file);
    std::size_t others = 0, visual = 0;
    std::set<std::string> reasons;
    for (const MjcfGeom& geom : geoms_of(*root, file.string())) {
        std::string why;
        if (!geom.collides()) {
            ++visual;
        } else if (const auto element = elements.element_of(geom, why)) {
            link_of(result, name_of_body(*geom.body)).elements.add(*element);
        } else {
            ++others;
            reasons.insert(why);
        }
    }
    if (others > 0) {
        result.notes.push_back(fmt::format("{} geom{} no convex element ({}) and left out", others,
                                           others == 1 ? " is" : "s are", fmt::join(reasons, ", ")));
    }
    if (visual > 0) {
        result.notes.push_back(
            fmt::format("{} geom{} without contact and left out", visual, visual == 1 ? " is" : "s are"));
    }
    return result;
}

} // namespace foam::xml_models
