// Figures and proofs of all links.
#include <foam/base/error.hpp>
#include <foam/base/parallel.hpp>
#include <foam/base/random.hpp>
#include <foam/geometry/measure.hpp>
#include <foam/geometry/inner.hpp>
#include <foam/geometry/internal/proof.hpp>
#include <foam/judge/evaluate.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

namespace foam::inline judge {
namespace {

/// Returns the standard error of a share that was estimated with independent points. One point of each kind is added to
/// the observed ones (Laplace's rule), so that a share without counterexamples does not count as exact. The points are
/// stratified: the true error is smaller.
double share_error(double share, std::size_t points) {
    const double n = static_cast<double>(points) + 2, p = (share * static_cast<double>(points) + 1) / n;
    return std::sqrt(p * (1 - p) / n);
}

Figures figures_of(const OriginalLink& link, const Elements& elements, std::uint64_t seed) {
    MeasureOptions options;
    options.seed = derive_seed(seed, link.link);
    Figures figures;
    figures.measures = measure(*link.solid, elements, options);
    const bool exact = figures.measures.certified || figures.measures.spheres == 0;
    figures.covered_error = exact ? 0 : share_error(figures.measures.covered, options.surface_points);
    return figures;
}

Figures total_of(const std::vector<Figures>& links) {
    std::vector<Measures> measures;
    double variance = 0;
    for (const Figures& link : links) {
        measures.push_back(link.measures);
        const double error = link.covered_error * link.measures.area;
        variance += error * error;
    }
    Figures sum;
    sum.measures = total(measures);
    sum.covered_error = sum.measures.area > 0 ? std::sqrt(variance) / sum.measures.area : 0;
    return sum;
}

LinkProof prove_outer(const Solid& solid, const Elements& elements) {
    const geometry::CoverProof proof = geometry::prove_cover(solid, elements);
    const Certificate& certificate = proof.certificate;
    return {.holds = certificate.holds,
            .growth = certificate.growth,
            .witness = certificate.witness,
            .triangle = certificate.triangle,
            .cavity = certificate.cavity,
            .triangles = proof.triangles,
            .pieces = certificate.pieces,
            .halvings = proof.halvings};
}

LinkProof prove_inner(const Solid& solid, std::span<const Sphere> spheres) {
    const InnerCertificate certificate = certify_inner(solid, spheres);
    LinkProof proof{.holds = certificate.holds, .growth = certificate.excess, .sphere = certificate.sphere};
    if (!proof.holds) {
        proof.witness = spheres[proof.sphere].center;
    }
    return proof;
}

} // namespace

Evaluation evaluate(const Original& original, const MatchedModel& model, std::uint64_t seed) {
    Evaluation result;
    result.links.resize(original.links.size());
    parallel_for(original.links.size(),
                 [&](std::size_t i) { result.links[i] = figures_of(original.links[i], model.elements[i], seed); });
    result.total = total_of(result.links);
    std::vector<Figures> with_spheres;
    for (const Figures& link : result.links) {
        if (link.measures.spheres > 0) {
            with_spheres.push_back(link);
        }
    }
    result.with_spheres = total_of(with_spheres);
    return result;
}

std::vector<LinkProof> prove(const Original& original, const MatchedModel& model, Guarantee guarantee) {
    if (guarantee == Guarantee::fitted) {
        throw Error(ErrorCode::usage, "there is no proof of the guarantee fitted; remedy: outer or inner");
    }
    if (guarantee == Guarantee::inner &&
        !std::all_of(model.elements.begin(), model.elements.end(), std::mem_fn(&Elements::are_spheres))) {
        throw Error(ErrorCode::usage, fmt::format("{}: only spheres are proved to lie inside the geometry, and it has "
                                                  "other elements; remedy: outer",
                                                  model.file.file.string()));
    }
    std::vector<LinkProof> proofs(original.links.size());
    parallel_for(proofs.size(), [&](std::size_t i) {
        const Solid& solid = *original.links[i].solid;
        proofs[i] =
            guarantee == Guarantee::outer ? prove_outer(solid, model.elements[i]) : prove_inner(solid, model.elements[i].spheres());
    });
    return proofs;
}

} // namespace foam::judge
