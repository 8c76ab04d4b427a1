#include "loader.hpp"

#include "files.hpp"
#include "frame.hpp"
#include "locale.hpp"
#include "scene.hpp"

#include <foam/base/error.hpp>
#include <foam/base/file.hpp>
#include <foam/base/text.hpp>

#include <assimp/Importer.hpp>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <new>

namespace foam::load_assimp {
namespace {

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

} // namespace

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

} // namespace foam::load_assimp
