// Sphere models in XML: SRDF and MJCF, read.* and write.*.
#include "mjcf.hpp"
#include "srdf.hpp"

#include <foam/sdk/plugin.hpp>

FOAM_PLUGIN("xml_models", "1.0", "Apache-2.0") {
    using namespace foam::xml_models;
    using foam::Parameter;
    enrol.add<SrdfWriter>(
        {.name = "write.srdf",
         .summary = "Writes an SRDF: pairs of links that need no check, and the spheres of links as a side-car.",
         .reference = "https://github.com/moveit/srdfdom",
         .parameters = {foam::pairs_parameter()},
         .extensions = {"srdf"},
         .consumer = {.name = "srdfdom (e23af6e63a), Pinocchio 3.7, Tesseract (c3f7109d07)",
                      .pairs = true,
                      .elements_optional = true,
                      .edits = true}});
    enrol.add<MjcfWriter>(
        {.name = "write.mjcf",
         .summary = "Writes the robot as MJCF: bodies with their elements, joints, inertias, pairs without contact and the rest pose.",
         .reference = "https://mujoco.readthedocs.io/en/stable/XMLreference.html",
         .parameters = {Parameter::choice("base", {"fixed", "free"}, "fixed")
                            .doc("fixed: the base is part of the world; free: it moves freely, as an object does."),
                        Parameter::number("density", 1000)
                            .bounds(1e-3, 1e5)
                            .unit("kg/m³")
                            .doc("Density of the geometry of links without <inertial>.")
                            .source("MuJoCo's own default."),
                        foam::segments_parameter(),
                        Parameter::boolean("collision", false)
                            .doc("With 'into': also replace geoms with contact that are no spheres."),
                        foam::pairs_parameter()},
         .extensions = {"mjcf"},
         .kinds = foam::every_kind(),
         .consumer = {.name = "MuJoCo 2.2.2 and 3.12 (a7255075b0)", .pairs = true, .rest_pose = true, .edits = true}});
    enrol.add<SrdfReader>({.name = "read.srdf",
                           .summary = "Reads the spheres of links of an SRDF: link_sphere_approximation.",
                           .reference = "https://github.com/moveit/srdfdom",
                           .extensions = {"srdf"}});
    enrol.add<MjcfReader>(
        {.name = "read.mjcf",
         .summary = "Reads the spheres and other convex elements of an MJCF file: geoms of its bodies.",
         .reference = "https://mujoco.readthedocs.io/en/stable/XMLreference.html",
         .extensions = {"xml", "mjcf"}});
}
