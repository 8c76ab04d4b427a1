#include "output.hpp"

#include "geometry/proof.hpp"

#include <foam/inner.hpp>
#include <foam/measure.hpp>

#include <fmt/format.h>

namespace foam {
namespace {

/// What the spheres lack of the guarantee; empty if it is proved, and then `took` is filled in.
std::string broken_promise(const Solid& solid, const std::vector<Sphere>& spheres, Guarantee guarantee,
                           WrittenProof& took) {
    took.spheres = spheres.size();
    if (guarantee == Guarantee::outer) {
        const geometry::CoverProof cover = geometry::prove_cover(solid, spheres);
        const Certificate& proof = cover.certificate;
        took.triangles = cover.triangles;
        took.pieces = proof.pieces;
        took.halvings = cover.halvings;
        return proof.holds ? ""
                           : fmt::format("{} m are missing at [{}, {}, {}]", proof.growth, proof.witness.x,
                                         proof.witness.y, proof.witness.z);
    }
    const InnerCertificate proof = certify_inner(solid, spheres);
    took.triangles = solid.surface().triangles.size();
    return proof.holds ? "" : fmt::format("sphere {} sticks out by {} m", proof.sphere, proof.excess);
}

std::vector<WrittenProof> check_written(const Workspace& workspace, const FinishedModel& finished,
                                        const OutputCall& output, const std::string& bytes, const Writer& writer) {
    const auto spheres = writer.read(bytes);
    std::vector<WrittenProof> proofs;
    for (const FinishedLink& link : finished.links) {
        const std::string& name = link.work->link->name;
        const auto found = spheres.find(name);
        if (found == spheres.end() || found->second.empty()) {
            throw Error(ErrorCode::internal,
                        fmt::format("{}: link '{}' has no spheres in the written file", output.file, name));
        }
        if (!link.work->report.measures.certified) {
            continue;
        }
        WrittenProof& took = proofs.emplace_back(WrittenProof{.link = name});
        if (const std::string lack = broken_promise(*link.solid, found->second, workspace.recipe.guarantee, took);
            !lack.empty()) {
            throw Error(ErrorCode::internal,
                        fmt::format("{}: link '{}': the certificate does not hold on the numbers read back: {}",
                                    output.file, name, lack));
        }
    }
    return proofs;
}

} // namespace

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
                file.proofs = check_written(workspace, finished, output, text, *writer);
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
