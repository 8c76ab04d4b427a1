#include "output.hpp"

#include <foam/measure.hpp>

#include <fmt/format.h>

namespace foam {
namespace {

/// True if the file holds the finest level: a writer may be told to write a coarser one.
void check_written(const Workspace& workspace, const FinishedModel& finished, const OutputCall& output,
                   const std::string& bytes, const Writer& writer) {
    const auto spheres = writer.read(bytes);
    for (const FinishedLink& link : finished.links) {
        const std::string& name = link.work->link->name;
        const auto found = spheres.find(name);
        if (found == spheres.end() || found->second.empty()) {
            throw Error(ErrorCode::internal,
                        fmt::format("{}: link '{}' has no spheres in the written file", output.file, name));
        }
        if (workspace.recipe.guarantee != Guarantee::outer || !link.work->report.measures.certified) {
            continue;
        }
        const Certificate proof = certify(*link.solid, found->second);
        if (!proof.holds) {
            throw Error(
                ErrorCode::internal,
                fmt::format(
                    "{}: link '{}': the certificate does not hold on the numbers read back: {} m are missing at "
                    "[{}, {}, {}]",
                    output.file, name, proof.growth, proof.witness.x, proof.witness.y, proof.witness.z));
        }
    }
}

} // namespace

std::vector<OutputFile> write_outputs(const Workspace& workspace, const FinishedModel& finished,
                                      const RunDirectory& directory) {
    std::vector<OutputFile> files(workspace.recipe.outputs.size());
    workspace.journal.expect(files.size());
    parallel_for(files.size(), [&](std::size_t i) {
        const OutputCall& output = workspace.recipe.outputs[i];
        StageReport report;
        const std::string bytes =
            run_stage(workspace, output.writer.stage, "", output.file, output.file, report, [&](Context& context) {
                const auto writer = workspace.registry.make<Writer>(output.writer.stage, output.writer.given);
                std::string text = writer->write(finished.model, context);
                check_written(workspace, finished, output, text, *writer);
                return text;
            });
        directory.write(output.file, bytes);
        files[i] = {output.writer.stage, output.file, digest_of(bytes), bytes.size()};
    });
    return files;
}

} // namespace foam
