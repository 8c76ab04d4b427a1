// Small scene files as text.
#pragma once

#include <string>

namespace foam::test {

inline constexpr const char* identity = "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1";

/// COLLADA: a geometry 'g' of the square (0,0) (100,0) (100,100) (0,100) with the faces `primitives`, whose vertices
/// are
/// '#v'; a scene with `nodes`. Y is up. Nine lines: line 4 holds the points, 5 the primitives, 7 the nodes.
inline std::string collada_scene(const std::string& unit, const std::string& primitives, const std::string& nodes,
                                 const std::string& libraries = "") {
    return R"(<?xml version="1.0"?>
<COLLADA version="1.4.1"><asset>)" +
           unit + R"(</asset>
<library_geometries><geometry id="g"><mesh><source id="s"><float_array id="a" count="12">
0 0 0 100 0 0 100 100 0 0 100 0</float_array><technique_common><accessor source="#a" count="4" stride="3"><param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source><vertices id="v"><input semantic="POSITION" source="#s"/></vertices>
)" + primitives +
           R"(</mesh></geometry></library_geometries>)" + libraries + R"(
<library_visual_scenes><visual_scene id="sc">
)" + nodes +
           R"(
</visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#sc"/></scene></COLLADA>)";
}

/// The triangles with these indices in one node with this matrix.
inline std::string collada(const std::string& unit, const std::string& indices, const std::string& matrix) {
    return collada_scene(unit,
                         "<triangles count=\"1\"><input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/><p>" + indices +
                             "</p></triangles>",
                         "<node><matrix>" + matrix + "</matrix><instance_geometry url=\"#g\"/></node>");
}

/// glTF: the triangle (0,0,0) (1,0,0) (0,1,0) in a base64 buffer of 36 bytes, its accessor with `count` elements.
inline std::string gltf(const std::string& nodes, const std::string& count) {
    return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":)" + nodes +
           R"(,"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"buffers":[{"byteLength":36,"uri":)"
           R"("data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}],)"
           R"("bufferViews":[{"buffer":0,"byteLength":36}],"accessors":[{"bufferView":0,"componentType":5126,"type":"VEC3","count":)" +
           count + "}]}";
}

} // namespace foam::test
