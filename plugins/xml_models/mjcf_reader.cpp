// The spheres of MJCF: geoms of bodies that take part in contacts.
#include "attributes.hpp"
#include "mjcf.hpp"
#include "mjcf_geoms.hpp"

#include <foam/base/error.hpp>

#include <fmt/format.h>

namespace foam::xml_models {
namespace {

Sphere sphere_of(const MjcfGeom& geom, const std::string& file) {
    if (!geom.sized) {
        throw Error(ErrorCode::input, fmt::format("{}:{}: the sphere has no size", file, geom.geom->line));
    }
    Vec3 center;
    if (geom.geom->attribute("pos")) {
        const std::vector<double> pos = numbers_of(*geom.geom, "pos", 3, file);
        center = {pos[0], pos[1], pos[2]};
    }
    return {center, numbers_of(*geom.sized, "size", 0, file).front()};
}

} // namespace

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
    std::size_t others = 0, visual = 0;
    for (const MjcfGeom& geom : geoms_of(*root, file.string())) {
        if (!geom.collides) {
            ++visual;
        } else if (!geom.sphere) {
            ++others;
        } else {
            spheres_of(result, name_of_body(*geom.body)).push_back(sphere_of(geom, file.string()));
        }
    }
    const auto note = [&](std::size_t count, const char* one, const char* many) {
        if (count > 0) {
            result.notes.push_back(fmt::format("{} geom{} and left out", count, count == 1 ? one : many));
        }
    };
    note(others, " is no sphere", "s are no spheres");
    note(visual, " is without contact", "s are without contact");
    return result;
}

} // namespace foam::xml_models
