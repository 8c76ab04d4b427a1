// Writing of the model, and the proof on the written files.
#pragma once

#include <foam/runtime/internal/run_directory.hpp>
#include <foam/runtime/internal/written_proof.hpp>

#include <string>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] runtime {

struct OutputFile {
    std::string stage; ///< the writer; empty for a debug mesh
    std::string file;  ///< relative to the run directory
    Digest digest;
    std::size_t bytes = 0;
    std::vector<WrittenProof> proofs = {}; ///< of the links whose guarantee is proved
    /// Digest of the writer's output without a folder, if that differs: the same for every place of the run directory.
    Digest portable_digest = {};
};

/// Returns the file that an output edits; nothing for an output that writes a whole file.
std::optional<TextFile> into_of(const Workspace& workspace, const OutputCall& output);

/// Writes every output of the recipe, reads it back as another program would, compares the spheres and runs the
/// certificate on the numbers read. Throws Error(internal) if a proof that held in memory does not hold on the file.
std::vector<OutputFile> write_outputs(const Workspace& workspace, const FinishedModel& finished,
                                      const RunDirectory& directory);

} // namespace runtime
} // namespace foam
