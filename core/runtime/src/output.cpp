#include <foam/runtime/internal/output.hpp>

#include <foam/base/internal/files.hpp>

namespace foam::inline runtime {

/// Returns the file whose spheres the output replaces.
static std::optional<TextFile> into_of(const Workspace& workspace, const OutputCall& output) {
    if (output.into.empty()) {
        return {};
    }
    const std::filesystem::path file =
        std::filesystem::absolute(workspace.recipe.file.parent_path() / output.into).lexically_normal();
    return TextFile{file, read_file(file, most_robot_bytes)};
}

std::vector<OutputFile> write_outputs(const Workspace& workspace, const FinishedModel& finished,
                                      const RunDirectory& directory) {
    const std::vector<OutputCall>& outputs = workspace.recipe.outputs;
    std::vector<std::string> texts(outputs.size());
    std::vector<std::unique_ptr<Writer>> writers(outputs.size());
    const auto as_task = [&](std::size_t i, const auto& body) {
        StageReport report;
        return run_stage(workspace, outputs[i].writer.stage, "", outputs[i].file, outputs[i].file, report, body);
    };
    workspace.journal.begin("writing");
    workspace.journal.expect(outputs.size());
    std::vector<OutputFile> files(outputs.size());
    parallel_for(outputs.size(), [&](std::size_t i) {
        texts[i] = as_task(i, [&](Context& context) {
            writers[i] = workspace.registry.make<Writer>(outputs[i].writer.stage, outputs[i].writer.given);
            SphereModel model = finished.model;
            model.into = into_of(workspace, outputs[i]);
            QuietContext quiet;
            const std::string portable = writers[i]->write(model, quiet);
            model.folder = (directory.target() / outputs[i].file).parent_path();
            std::string text = writers[i]->write(model, context);
            files[i].portable_digest = portable == text ? "" : digest_of(portable);
            return text;
        });
    });
    workspace.journal.begin("proof");
    workspace.journal.expect(outputs.size());
    parallel_for(outputs.size(), [&](std::size_t i) {
        OutputFile& file = files[i];
        file.proofs = as_task(i, [&](Context&) {
            return prove_written(writers[i]->read(texts[i]), finished, workspace.recipe.guarantee,
                                 workspace.recipe.proved_numbers(workspace.registry), outputs[i].file);
        });
        directory.write(outputs[i].file, texts[i]);
        file.stage = outputs[i].writer.stage;
        file.file = outputs[i].file;
        file.digest = digest_of(texts[i]);
        file.bytes = texts[i].size();
    });
    return files;
}

} // namespace foam::runtime
