#include "frame.hpp"
#include "loader.hpp"

#include <foam/sdk/plugin.hpp>

namespace {

/// Returns the extensions of formats from which assimp 5.2 reads triangles. Not: motions without a surface (bvh, csm),
/// game levels (bsp, pk3), extensions that do not determine the format (xml).
std::vector<std::string> endings() {
    return {"3ds", "fbx", "x3d", "3mf", "amf", "ac", "ac3d", "acc", "lwo", "lws", "lxo", "ms3d", "blend", "x", "ase",
            "ask", "dxf", "ifc", "zae", "b3d", "cob", "scn", "hmp", "iqm", "irr", "irrmesh", "md2", "md3", "mdc", "mdl",
            "md5mesh", "mesh", "ndo", "nff", "enff", "ogex", "pmx", "prj", "q3o", "q3s", "raw", "sib", "smd", "ter",
            "xgl", "zgl", "ifczip", "assbin",
            // load.mesh comes first
            "stl", "obj", "dae", "ply", "off", "gltf", "glb"};
}

} // namespace

FOAM_PLUGIN("load_assimp", "1.0", "Apache-2.0") {
    using foam::Parameter;
    const auto with_unit = foam::load_assimp::endings_with_unit();
    enrol.add<foam::load_assimp::Loader>(
        {.name = "load.assimp",
         .summary = "Reads meshes by the library assimp, in single precision: 3DS, FBX, X3D, 3MF, AMF, AC3D, LWO, "
                    "Milkshape, Blender and others.",
         .reference = "Open Asset Import Library, https://github.com/assimp/assimp",
         .parameters = {Parameter::integer("max_triangles", 20'000'000)
                            .unit("1")
                            .bounds(1, 1'000'000'000)
                            .doc("A file with more triangles is refused.")
                            .source("about 2 GB of memory in the stages that follow"),
                        Parameter::integer("max_bytes", std::int64_t{1} << 30)
                            .unit("B")
                            .bounds(1, 1e12)
                            .doc("A larger file is refused before it is read, with those that it refers to.")
                            .source("as load.mesh")},
         .extensions = endings(),
         .extensions_with_unit = {with_unit.begin(), with_unit.end()},
         .isolation = {.process = true, .time_limit = 60, .memory_limit = 4096},
         .last_resort = true});
}
