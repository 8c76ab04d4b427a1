#include "loader.hpp"

#include <foam/sdk/plugin.hpp>

FOAM_PLUGIN("load_mesh", "1.0", "Apache-2.0") {
    using foam::Parameter;
    enrol.add<foam::load_mesh::Loader>(
        {.name = "load.mesh",
         .summary = "Reads triangle meshes in double precision: STL, OBJ, PLY, OFF, COLLADA and glTF 2.0.",
         .parameters = {Parameter::integer("max_triangles", 20'000'000)
                            .unit("1")
                            .bounds(1, 1'000'000'000)
                            .doc("A file with more triangles is refused.")
                            .source("about 2 GB of memory in the stages that follow"),
                        Parameter::integer("max_bytes", std::int64_t{1} << 30)
                            .unit("B")
                            .bounds(1, 1e12)
                            .doc("A larger file is refused before it is read.")
                            .source("a binary STL of 20 million triangles is 1 GB")},
         .extensions = {"stl", "obj", "dae", "ply", "off", "gltf", "glb"},
         .extensions_with_unit = {"dae", "gltf", "glb"}});
}
