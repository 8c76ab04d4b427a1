#include "output.hpp"

namespace foam {

std::vector<OutputFile> write_outputs(const Workspace& workspace, const FinishedModel& finished,
                                      const RunDirectory& directory) {
    std::vector<OutputFile> files(workspace.recipe.outputs.size());
    workspace.journal.expect(files.size());
    parallel_for(files.size(), [&](std::size_t i) {
        const OutputCall& output = workspace.recipe.outputs[i];
        StageReport report;
        OutputFile& file = files[i];
        const std::string bytes =
            run_stage(workspace, output.writer.stage, "", output.file, output.file, report, [&](Context& context) {
                const auto writer = workspace.registry.make<Writer>(output.writer.stage, output.writer.given);
                SphereModel model = finished.model;
                model.folder = (directory.target() / output.file).parent_path();
                std::string text = writer->write(model, context);
                file.proofs = prove_written(writer->read(text), finished, workspace.recipe.guarantee, output.file);
                QuietContext quiet;
                const std::string portable = writer->write(finished.model, quiet);
                file.portable_digest = portable == text ? "" : digest_of(portable);
                return text;
            });
        directory.write(output.file, bytes);
        file.stage = output.writer.stage;
        file.file = output.file;
        file.digest = digest_of(bytes);
        file.bytes = bytes.size();
    });
    return files;
}

} // namespace foam
