#include <foam/runtime/internal/written_proof.hpp>

#include <foam/geometry/inner.hpp>
#include <foam/geometry/internal/proof.hpp>
#include <foam/geometry/measure.hpp>

#include <fmt/format.h>

namespace foam::inline runtime {
namespace {

/// Returns the violation of the guarantee by the spheres; empty if the guarantee is proved, and then `took` is filled
/// in.
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
    return proof.holds ? "" : fmt::format("sphere {} protrudes by {} m", proof.sphere, proof.excess);
}

std::vector<Sphere> in_single_precision(std::vector<Sphere> spheres) {
    const auto single = [](double value) { return static_cast<double>(static_cast<float>(value)); };
    for (Sphere& s : spheres) {
        s = {{single(s.center.x), single(s.center.y), single(s.center.z)}, single(s.radius)};
    }
    return spheres;
}

} // namespace

std::vector<WrittenProof> prove_written(const std::map<std::string, std::vector<Sphere>>& read,
                                        const FinishedModel& finished, Guarantee guarantee, Numbers numbers,
                                        const std::string& file) {
    std::vector<WrittenProof> proofs;
    for (const FinishedLink& link : finished.links) {
        const std::string& name = link.work->link->name;
        const auto found = read.find(name);
        if (found == read.end() || found->second.empty()) {
            throw Error(ErrorCode::internal,
                        fmt::format("{}: link '{}' has no spheres in the written file", file, name));
        }
        if (!link.work->report.measures.certified) {
            continue;
        }
        WrittenProof& took = proofs.emplace_back(WrittenProof{.link = name});
        const auto require = [&](const std::vector<Sphere>& spheres, const char* which) {
            if (const std::string lack = broken_promise(*link.solid, spheres, guarantee, took); !lack.empty()) {
                throw Error(ErrorCode::internal,
                            fmt::format("{}: link '{}': the certificate does not hold for the numbers read back{}: {}",
                                        file, name, which, lack));
            }
        };
        if (numbers == Numbers::float32) {
            require(in_single_precision(found->second), " in single precision");
            took.float32 = true;
        }
        require(found->second, "");
    }
    return proofs;
}

} // namespace foam::runtime
