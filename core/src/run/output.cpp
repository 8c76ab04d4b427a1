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
            model.folder = (directory.target() / outputs[i].file).parent_path();
            std::string text = writers[i]->write(model, context);
            QuietContext quiet;
            const std::string portable = writers[i]->write(finished.model, quiet);
            files[i].portable_digest = portable == text ? "" : digest_of(portable);
            return text;
        });
    });
    workspace.journal.begin("proof");
    workspace.journal.expect(outputs.size());
    parallel_for(outputs.size(), [&](std::size_t i) {
        OutputFile& file = files[i];
        file.proofs =
            as_task(i, [&](Context&) { return check_written(workspace, finished, outputs[i], texts[i], *writers[i]); });
        directory.write(outputs[i].file, texts[i]);
        file.stage = outputs[i].writer.stage;
        file.file = outputs[i].file;
        file.digest = digest_of(texts[i]);
        file.bytes = texts[i].size();
    });
    return files;
}

} // namespace foam
