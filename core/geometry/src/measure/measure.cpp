#include <foam/geometry/measure.hpp>

#include "measure/element_set.hpp"

#include <foam/geometry/internal/solids.hpp>
#include <foam/geometry/objective.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace foam::inline geometry {
namespace {

double ratio(double volume, double of, double if_none) {
    return of > 0 ? volume / of : volume > 0 ? if_none : 0;
}

} // namespace

double missing_share(double missing_volume, double volume) {
    return std::min(1.0, ratio(missing_volume, volume, 0));
}

void set_ratios(Measures& m) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    m.excess = ratio(m.excess_volume, m.volume, infinity);
    m.missing = missing_share(m.missing_volume, m.volume);
    // The error of vol(S) is in both volumes of the ratio. For excess, vol(U) / vol(S) - 1 + missing, the errors add
    // up.
    const auto error = [&](double of_volume, double factor) {
        // For a volume near zero the factor is infinite, and no number times an error of 0.
        const double of_solid = m.volume_error > 0 ? factor * m.volume_error * m.volume_error : 0;
        return ratio(std::sqrt(of_volume * of_volume + of_solid), m.volume, 0);
    };
    m.excess_error = error(m.excess_volume_error, m.excess * (m.excess + 2));
    m.missing_error = error(m.missing_volume_error, m.missing * m.missing);
}

/// Measures a set of balls or of elements.
template <class Set>
static Measures measured(const Solid& solid, const Set& set, const Certificate& certificate,
                         const MeasureOptions& options) {
    Measures result;
    result.spheres = set.size();
    result.area = solid.area();
    result.volume = solid.volume();
    result.volume_error = solid.volume_error();
    result.certified = certificate.holds;
    result.covers = solid.covers();
    const bool surface_held = certificate.holds || certificate.cavity;
    result.gap = surface_held ? 0 : certificate.growth;
    result.covered = surface_held ? 1 : geometry::covered_share(solid, set, options);
    const geometry::Difference difference = geometry::volume_difference(solid, set, certificate.holds, options);
    result.excess_volume = difference.excess.value;
    result.excess_volume_error = difference.excess.error;
    result.missing_volume = difference.missing.value;
    result.missing_volume_error = difference.missing.error;
    set_ratios(result);
    const geometry::Protrusion protrusion = geometry::protrusion(solid, set, options.directions_per_sphere);
    result.exposed_area = protrusion.exposed_area;
    result.protrusion_max = protrusion.max;
    result.protrusion_mean = protrusion.mean;
    return result;
}

static Measures measure_spheres(const Solid& solid, const std::vector<Sphere>& spheres, const MeasureOptions& options) {
    std::vector<Sphere> balls;
    for (const Sphere& s : spheres) {
        if (is_finite(s.center) && std::isfinite(s.radius) && s.radius > 0) {
            balls.push_back(s);
        }
    }
    return measured(solid, std::span<const Sphere>(balls), certify(solid, balls), options);
}

Measures measure(const Solid& solid, const Elements& elements, const MeasureOptions& options) {
    if (elements.are_spheres()) {
        return measure_spheres(solid, elements.spheres(), options);
    }
    return measured(solid, ElementSet(elements), certify(solid, elements), options);
}

Measures bounds_of_measures(const Solid& solid, const Elements& elements) {
    const Certificate certificate = certify(solid, elements);
    Box box = solid.bounds();
    Measures result;
    result.spheres = elements.size();
    result.area = solid.area();
    result.certified = certificate.holds;
    result.covers = solid.covers();
    const bool surface_held = certificate.holds || certificate.cavity;
    result.gap = surface_held ? 0 : certificate.growth;
    result.covered = surface_held ? 1 : 0;
    for (const Sphere& s : elements.spheres()) {
        box.add(Box::about(s.center, {s.radius, s.radius, s.radius}));
        result.excess_volume += 4 * std::numbers::pi / 3 * s.radius * s.radius * s.radius;
        result.exposed_area += 4 * std::numbers::pi * s.radius * s.radius;
    }
    for (const Element& element : elements.shaped()) {
        const Mesh mesh = enclosing_mesh(element);
        for (const Vec3& vertex : mesh.vertices) {
            box.add(vertex);
        }
        result.excess_volume += signed_volume(mesh);
        result.exposed_area += surface_area(mesh);
    }
    result.protrusion_max = result.protrusion_mean = box.diagonal();
    set_ratios(result);
    // A convex element leaves nothing of the inside out.
    const bool filled = result.certified && (result.spheres == 1 || result.covers == Covers::solid);
    result.missing = filled ? 0 : std::numeric_limits<double>::quiet_NaN();
    return result;
}

Measures total(std::span<const Measures> links) {
    Measures sum;
    sum.certified = !links.empty();
    double covered = 0, protrusion = 0, excess_variance = 0, missing_variance = 0, volume_variance = 0;
    for (const Measures& m : links) {
        sum.spheres += m.spheres;
        sum.area += m.area;
        sum.volume += m.volume;
        sum.exposed_area += m.exposed_area;
        sum.excess_volume += m.excess_volume;
        sum.missing_volume += m.missing_volume;
        sum.gap = std::max(sum.gap, m.gap);
        sum.protrusion_max = std::max(sum.protrusion_max, m.protrusion_max);
        sum.certified = sum.certified && m.certified;
        sum.covers = m.covers == Covers::surface ? m.covers : sum.covers;
        covered += m.covered * m.area;
        protrusion += m.protrusion_mean * m.exposed_area;
        excess_variance += m.excess_volume_error * m.excess_volume_error;
        missing_variance += m.missing_volume_error * m.missing_volume_error;
        volume_variance += m.volume_error * m.volume_error;
    }
    sum.covered = sum.area > 0 ? covered / sum.area : 0;
    sum.protrusion_mean = sum.exposed_area > 0 ? protrusion / sum.exposed_area : 0;
    sum.excess_volume_error = std::sqrt(excess_variance);
    sum.missing_volume_error = std::sqrt(missing_variance);
    sum.volume_error = std::sqrt(volume_variance);
    set_ratios(sum);
    if (std::any_of(links.begin(), links.end(), [](const Measures& m) { return std::isnan(m.missing); })) {
        sum.missing = std::numeric_limits<double>::quiet_NaN(); // not measured of some link
    }
    return sum;
}

std::vector<NamedFigure> named_figures(const Measures& m) {
    return {{"spheres", m.spheres},
            {"certified", m.certified},
            {"gap_m", m.gap},
            {"covered", m.covered},
            {"excess", m.excess},
            {"excess_standard_error", m.excess_error},
            {"excess_volume_m3", m.excess_volume},
            {"excess_volume_standard_error_m3", m.excess_volume_error},
            {"missing", m.missing},
            {"missing_standard_error", m.missing_error},
            {"missing_volume_m3", m.missing_volume},
            {"missing_volume_standard_error_m3", m.missing_volume_error},
            {"protrusion_max_m", m.protrusion_max},
            {"protrusion_mean_m", m.protrusion_mean},
            {"exposed_area_m2", m.exposed_area},
            {"volume_m3", m.volume},
            {"area_m2", m.area}};
}

std::optional<Objective> objective_named(std::string_view name) {
    static constexpr std::pair<std::string_view, Objective> objectives[] = {
        {"excess", Objective::excess},
        {"protrusion", Objective::protrusion},
        {"radius", Objective::radius},
        {"mean_protrusion", Objective::mean_protrusion}};
    const auto it = std::find_if(std::begin(objectives), std::end(objectives),
                                 [&](const auto& objective) { return objective.first == name; });
    return it == std::end(objectives) ? std::nullopt : std::optional(it->second);
}

} // namespace foam::inline geometry
