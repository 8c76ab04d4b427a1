// load.assimp: mesh files through the library assimp, for formats that load.mesh does not read.
//
// assimp trusts counts, ranges and nesting of a file. Therefore it requests process isolation (StageInfo), opens files
// only through Files, and its result is checked before any other use.
#include <foam/sdk/plugin.hpp>

#include "scene.hpp"

#include <foam/base/error.hpp>
#include <foam/base/file.hpp>
#include <foam/base/text.hpp>
#include <foam/sdk/stage.hpp>

#include <assimp/Importer.hpp>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <fmt/format.h>

#include <locale.h>

#include <algorithm>
#include <memory>
#include <new>

namespace foam::load_assimp {
namespace {

/// Sets the C locale for the calling thread during its lifetime.
class ScopedCLocale {
public:
    ScopedCLocale() : c_(newlocale(LC_ALL_MASK, "C", nullptr)), before_(uselocale(c_)) {}
    ~ScopedCLocale() {
        uselocale(before_);
        freelocale(c_);
    }
    ScopedCLocale(const ScopedCLocale&) = delete;
    ScopedCLocale& operator=(const ScopedCLocale&) = delete;

private:
    locale_t c_, before_;
};

class Loader final : public MeshLoader {
public:
    explicit Loader(const Parameters& parameters);
    Mesh load(const std::filesystem::path& file, Context& context) const override;

private:
    std::size_t max_triangles_;
    std::uintmax_t max_bytes_;
};

/// Configures the importer to read only geometry, with the axes of the file.
void configure(Assimp::Importer& importer) {
    importer.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true);
    importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
    importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_PRESERVE_PIVOTS, false);
    for (const char* key :
         {AI_CONFIG_IMPORT_FBX_READ_MATERIALS, AI_CONFIG_IMPORT_FBX_READ_TEXTURES, AI_CONFIG_IMPORT_FBX_READ_CAMERAS,
          AI_CONFIG_IMPORT_FBX_READ_LIGHTS, AI_CONFIG_IMPORT_FBX_READ_ANIMATIONS}) {
        importer.SetPropertyBool(key, false);
    }
}

/// Returns why assimp gave no scene. Throws bad_alloc if that is the reason.
std::string reason(const Assimp::Importer& importer) {
    if (const std::exception_ptr thrown = importer.GetException()) {
        try {
            std::rethrow_exception(thrown);
        } catch (const std::bad_alloc&) {
            throw;
        } catch (...) { // NOLINT: the text below says it
        }
    }
    constexpr std::size_t longest = 300;
    const std::string text = importer.GetErrorString();
    return text.empty() ? "it gives no reason" : text.substr(0, longest);
}

/// Returns the scene, as triangles, lines and points. The importer owns it.
const aiScene& read_scene(Assimp::Importer& importer, const std::string& file, std::size_t max_triangles) {
    const auto require = [&](const aiScene* scene) -> const aiScene& {
        if (!scene) {
            throw BadScene(fmt::format("assimp cannot read it: {}; remedy: export it again, or as STL, OBJ, PLY, DAE, "
                                       "OFF or GLB",
                                       reason(importer)));
        }
        return *scene;
    };
    const aiScene& scene = require(importer.ReadFile(file, 0));
    const bool polygons = check_faces(scene, max_triangles); // the next step trusts its indices
    return polygons ? require(importer.ApplyPostProcessing(aiProcess_Triangulate)) : scene;
}

Loader::Loader(const Parameters& parameters)
    : max_triangles_(static_cast<std::size_t>(parameters.integer("max_triangles"))),
      max_bytes_(static_cast<std::uintmax_t>(parameters.integer("max_bytes"))) {}

Mesh Loader::load(const std::filesystem::path& file, Context& context) const {
    const std::string ending = extension_of(file);
    const auto error = [&](const std::string& what) {
        return Error(ErrorCode::input, fmt::format("{}: {}", file.string(), what));
    };
    const ScopedCLocale locale;
    try {
        Assimp::Importer importer;
        auto owned = std::make_unique<Files>(file, max_bytes_);
        const Files& files = *owned;
        importer.SetIOHandler(owned.release()); // the importer owns it now
        configure(importer);
        const aiScene& scene = read_scene(importer, files.mesh(), max_triangles_);
        for (const std::string& refused : files.refused()) {
            context.log(Severity::info, fmt::format("left out what it refers to: {}", refused));
        }
        if (const std::string_view note = unit_note(ending); !note.empty()) {
            context.log(Severity::info, note);
        }
        Mesh mesh = mesh_of(scene, frame_of(scene, ending), max_triangles_, context);
        context.metric("triangles", static_cast<double>(mesh.triangles.size()), "1");
        context.metric("vertices", static_cast<double>(mesh.vertices.size()), "1");
        return mesh;
    } catch (const BadScene& bad) {
        throw error(bad.what());
    } catch (const std::bad_alloc&) {
        throw error("there is not enough memory for it; remedy: the file may be damaged, export it again; or raise "
                    "memory_limit of load.assimp");
    } catch (const std::length_error&) {
        throw error("it asks for more memory than there can be; remedy: the file is damaged, export it again");
    }
}

} // namespace
} // namespace foam::load_assimp

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
