#include "promises.hpp"

#include <foam/base/error.hpp>
#include <foam/base/internal/files.hpp>
#include <foam/runtime/scratch_folder.hpp>

#include <fstream>

namespace foam::inline runtime {
namespace {

namespace fs = std::filesystem;

fs::path written(const fs::path& file, const std::string& bytes) {
    std::ofstream(file, std::ios::binary) << bytes;
    return file;
}

void require_loaded(const fs::path& file, const Mesh& mesh) {
    require(!mesh.triangles.empty(), fmt::format("{}: it gives no triangle", file.string()));
    for (const Vec3& p : mesh.vertices) {
        require(is_finite(p), fmt::format("{}: it gives a vertex that is not finite", file.string()));
    }
    for (const Triangle& t : mesh.triangles) {
        for (const std::uint32_t corner : t) {
            require(corner < mesh.vertices.size(), fmt::format("{}: a triangle has vertex {}, there are {}",
                                                               file.string(), corner, mesh.vertices.size()));
        }
    }
}

/// Requires that the loader loads the file, or refuses it by an Error(input) that names the file.
void require_mesh_or_refusal(const MeshLoader& loader, const fs::path& file, bool must_refuse) {
    QuietContext context;
    try {
        require_loaded(file, loader.load(file, context));
    } catch (const Error& error) {
        const std::string message = error.what();
        require(error.code() == ErrorCode::input,
                fmt::format("it refuses with the wrong code: {}; remedy: ErrorCode::input", message));
        require(message.find(file.filename().string()) != message.npos,
                fmt::format("its message does not name the file: {}", message));
        return;
    }
    require(!must_refuse, fmt::format("it takes {} for a mesh", file.filename().string()));
}

} // namespace

void check_mesh_loader(const MeshLoader& loader, const StageInfo& info, const ContractOptions& options,
                       Promises& promises) {
    promises.check("says which files it reads", [&] {
        require(!info.extensions.empty(), "it declares no file name endings; remedy: .extensions = {\"…\"}");
    });
    const std::string ending = info.extensions.empty() ? "mesh" : info.extensions.front();
    promises.check("refuses what is no mesh", [&] {
        const ScratchFolder scratch;
        require_mesh_or_refusal(loader, scratch.path() / ("missing." + ending), true);
        require_mesh_or_refusal(loader, written(scratch.path() / ("empty." + ending), ""), true);
        require_mesh_or_refusal(loader, written(scratch.path() / ("noise." + ending), std::string(3000, '\x7f')), true);
    });
    for (const fs::path& sample : options.samples) {
        promises.check(fmt::format("loads {}, whole, and cut off without a crash", sample.filename().string()), [&] {
            QuietContext context;
            const Mesh mesh = loader.load(sample, context);
            require_loaded(sample, mesh);
            require(loader.load(sample, context) == mesh, "the second time it gives another mesh");
            const std::string bytes = read_file(sample);
            const ScratchFolder scratch;
            for (const std::size_t share : {1, 3, 5, 7}) {
                const fs::path cut = written(scratch.path() / fmt::format("cut{}{}", share, sample.extension().string()),
                                             bytes.substr(0, bytes.size() * share / 8));
                require_mesh_or_refusal(loader, cut, false);
            }
        });
    }
}

} // namespace foam::runtime
