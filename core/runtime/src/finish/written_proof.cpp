#include <foam/runtime/internal/links.hpp>

#include <foam/geometry/inner.hpp>
#include <foam/geometry/internal/proof.hpp>
#include <foam/geometry/measure.hpp>
#include <foam/runtime/internal/cover.hpp>
#include <foam/sdk/elements.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace foam::inline runtime {
namespace {

/// Returns the violation of the guarantee by the elements; empty if the guarantee is proved, and then `took` is filled
/// in.
std::string broken_promise(const Solid& solid, const Elements& elements, Guarantee guarantee, WrittenProof& took) {
    took.spheres = elements.size();
    if (guarantee == Guarantee::outer) {
        const geometry::CoverProof cover = geometry::prove_cover(solid, elements);
        const Certificate& proof = cover.certificate;
        took.triangles = cover.triangles;
        took.pieces = proof.pieces;
        took.halvings = cover.halvings;
        return proof.holds    ? ""
               : proof.cavity ? fmt::format("the point [{}, {}, {}] inside is {} m from all elements", proof.witness.x,
                                            proof.witness.y, proof.witness.z, proof.growth)
                              : fmt::format("{} m are missing at [{}, {}, {}]", proof.growth, proof.witness.x,
                                         proof.witness.y, proof.witness.z);
    }
    const InnerCertificate proof = certify_inner(solid, elements.spheres());
    took.triangles = solid.surface().triangles.size();
    return proof.holds ? "" : fmt::format("sphere {} protrudes by {} m", proof.sphere, proof.excess);
}

/// Returns the most by which a radius in the file is less than that of the model, or minus the most by which it is more;
/// 0 up to rounding.
double shrunk_by(const std::vector<Sphere>& model, const std::vector<Sphere>& file) {
    const auto largest = [](const std::vector<Sphere>& spheres) {
        double radius = 0;
        for (const Sphere& s : spheres) {
            radius = std::max(radius, s.radius);
        }
        return radius;
    };
    const double shrunk = model.empty() ? 0 : largest(model) - largest(file);
    return std::abs(shrunk) > 1e-5 * largest(model) ? shrunk : 0;
}

} // namespace

std::vector<WrittenProof> prove_written(const std::map<std::string, Elements>& read,
                                        const FinishedModel& finished, Guarantee guarantee, Numbers numbers,
                                        const std::string& file, bool elements_optional) {
    std::vector<WrittenProof> proofs;
    for (const FinishedLink& link : finished.links) {
        if (elements_optional && !link.elements.are_spheres()) {
            continue;
        }
        const std::string& name = link.work->link->name;
        const auto found = read.find(name);
        if (found == read.end() || found->second.size() == 0) {
            throw Error(ErrorCode::internal,
                        fmt::format("{}: link '{}' has no spheres in the written file", file, name));
        }
        if (!link.elements.are_spheres() && found->second.size() < least_count(link.elements)) {
            throw Error(ErrorCode::internal, fmt::format("{}: link '{}' has {} in the written file, the model has {}",
                                                         file, name, counts_text(kinds_of(found->second)),
                                                         counts_text(kinds_of(link.elements))));
        }
        if (!link.work->report.measures.certified) {
            continue;
        }
        const double buffer = shrunk_by(link.elements.spheres(), found->second.spheres());
        WrittenProof& took = proofs.emplace_back(WrittenProof{.link = name});
        const auto require = [&](const Elements& elements, const char* which) {
            if (const std::string lack = broken_promise(*link.solid, elements, guarantee, took); !lack.empty()) {
                const std::string hint =
                    buffer == 0 ? ""
                                : fmt::format("; with its buffer, the file's reader takes radii that are {} m {} than the "
                                              "model's; remedy: leave the buffer out, or state guarantee: fitted",
                                              std::abs(buffer), buffer > 0 ? "less" : "more");
                throw Error(buffer == 0 ? ErrorCode::internal : ErrorCode::output,
                            fmt::format("{}: link '{}': the certificate does not hold for the numbers read back{}: {}{}",
                                        file, name, which, lack, hint));
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
