// Robots and models that are made here: no reader takes part.
#pragma once

#include "geometry/plain_shapes.hpp"

#include <foam/judge/evaluate.hpp>

namespace foam::test {

inline const Element cube = Element::box({0.2, 0.2, 0.2});

/// Returns a robot of links with a cube each. `left_out`: a link that is not judged.
inline Original cubes_of_links(const std::vector<std::string>& links, const std::string& left_out = "") {
    Robot robot;
    robot.name = "made";
    Original original;
    original.file = "folder/robot.urdf";
    for (const std::string& name : links) {
        Link link{.name = name, .collisions = {}, .visuals = {}};
        link.collisions.push_back({.origin = {}, .geometry = cube, .name = ""});
        robot.links.push_back(link);
        if (name != left_out) {
            original.links.push_back({name, primitive_solid(cube)});
        }
    }
    original.robot = std::make_shared<const Robot>(robot);
    return original;
}

inline SphereFile file_of(std::vector<LinkSpheres> links, const std::filesystem::path& path) {
    SphereFile file;
    file.file = path;
    file.format = "test";
    file.links = std::move(links);
    return file;
}

} // namespace foam::test
