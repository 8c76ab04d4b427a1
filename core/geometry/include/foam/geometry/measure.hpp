// Proof, growth and figures of convex elements. Symbols: S the original geometry, U the union of the elements. Spheres alone
// take quicker paths of their own.
#pragma once

#include <foam/geometry/solid.hpp>
#include <foam/geometry/sphere.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <variant>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] geometry {

/// The figures of one link.
struct Measures {
    std::size_t spheres = 0;  ///< elements with a volume
    double area = 0;          ///< of ∂S, m²
    double volume = 0;        ///< vol(S), m³
    double covered = 0;       ///< area of ∂S inside U / area of ∂S
    double gap = 0;           ///< max over ∂S of the distance to U, m: from above, to 0.1 %; infinite without spheres
    double excess = 0;        ///< vol(U \ S) / vol(S); infinite if vol(S) = 0 (open surfaces without an inside)
    double excess_error = 0;  ///< standard error of excess
    double missing = 0;       ///< vol(S \ U) / vol(S); 0 if vol(S) = 0, and where a cover of the solid is proved
    double missing_error = 0; ///< standard error of missing
    double exposed_area = 0;  ///< of ∂U outside S, m²
    double protrusion_max = 0;                                ///< distance from the exposed surface of U to S, m
    double protrusion_mean = 0;                               ///< area-weighted mean of it, m
    bool certified = false;                                   ///< certify() holds
    Covers covers = Covers::solid;                            ///< what that proves
    double excess_volume = 0;                                 ///< vol(U \ S), m³
    double missing_volume = 0;                                ///< vol(S \ U), m³
    double excess_volume_error = 0, missing_volume_error = 0; ///< standard errors, m³
    double volume_error = 0;                                  ///< standard error of volume, m³; 0 where it is exact
};

struct MeasureOptions {
    std::uint64_t seed = 0;
    std::size_t surface_points = 100'000;
    /// Number of lines along which the smaller of vol(U \ S) and vol(S \ U) is integrated, exactly along each line. The
    /// other volume follows from vol(U) and vol(S).
    std::size_t volume_rays = 30'000;
    /// The same where S is not closed, with one line for every dozen points: holes cut a line into about as many
    /// pieces. Around elements that overlap and are not all spheres, one for every four dozen.
    std::size_t volume_points = 200'000;
    std::size_t directions_per_sphere = 1'000;
};

/// Measures the figures. Equal seeds give equal numbers on any number of threads. `certified` and `gap` come from
/// certify(). Elements that are not valid count as absent. Volumes are integrated along lines, exactly along each line; for spheres
/// alone vol(U) is exact.
Measures measure(const Solid& solid, const Elements& elements, const MeasureOptions& options = {});
/// Returns the figures over a robot: counts and volumes are sums, gap and protrusion_max are maxima, covered and
/// protrusion_mean are weighted by area, certified is true if all links are certified.
Measures total(std::span<const Measures> links);

/// Returns the volume of the union, m³. For spheres alone by the divergence theorem over their exposed surfaces, with `directions`
/// Fibonacci points per ball: relative error about 1/directions, O(n² · directions) at worst. Else integrated along lines that are the
/// same for equal bounds: relative error about 1e-3.
double union_volume(const Elements& elements, std::size_t directions = 1'000);
/// Returns vol(S \ U), m³, along the solid's lines.
double missing_volume(const Solid& solid, const Elements& elements);
/// Returns vol(S \ U) / vol(S), the figure `missing`: 0 if vol(S) = 0. It is at most 1, although both volumes may come
/// from different lines.
double missing_share(double missing_volume, double volume);
/// Returns vol(U \ S), m³, along lines that are the same for all elements of a solid, so that results for one solid can be compared.
double excess_volume(const Solid& solid, const Elements& elements);
/// Returns excess_volume() and missing_volume(), in the time of the first alone.
std::pair<double, double> excess_and_missing_volume(const Solid& solid, const Elements& elements);

/// The result of the proof that elements cover a solid.
struct Certificate {
    bool holds = false;
    Covers covers = Covers::solid; ///< what is proved: that of the solid
    std::size_t pieces = 0; ///< triangles, and pieces of them, that were examined
    double growth = 0;      ///< m; if it does not hold: growth of the nearest element that would close the worst piece
    Vec3 witness{};         ///< if it does not hold: a corner of that piece
    std::uint32_t triangle = 0; ///< if it does not hold: the triangle of Solid::surface() it lies on
    /// If it does not hold: the elements hold the surface, but the witness is inside. `growth` is then its distance from
    /// them, or 0 if it is not known whether they hold it.
    bool cavity = false;
};

/// Proves that the union of the elements holds the solid: every triangle of solid.surface(), and with them the insides of all parts
/// that have one, unless solid.covers() says otherwise. An element that contains the corners of a convex piece contains the piece;
/// otherwise the piece is cut along the faces of an element, or halved, to `depth` halvings of its longest edge. Then no region
/// inside is left between the elements. Rounding is on the safe side: an uncovered point never passes.
/// docs/dev/certificate.md has the argument.
Certificate certify(const Solid& solid, const Elements& elements, int depth = 40);
/// Returns whether certify() holds. Where it does not, this takes much less time: the gap is not searched for.
bool covers(const Solid& solid, const Elements& elements);

/// Returns the elements grown by about the least that makes certify() hold; none becomes smaller, and elements that cover already
/// stay as they are. Throws Error(geometry) if no element is valid.
Elements grown_to_cover(const Solid& solid, Elements elements);
/// Returns the same of spheres. Centres stay. Of the spheres that could close a gap, the one grows that adds least excess volume.
/// Then grown spheres shrink as far as the others allow.
std::vector<Sphere> grown_to_cover(const Solid& solid, std::vector<Sphere> spheres);

using NamedFigure = std::pair<const char*, std::variant<std::size_t, double, bool>>;

/// Returns the figures of a link or of the whole under their names, which end in the unit; ratios have none. A figure
/// that is infinite is null in JSON.
std::vector<NamedFigure> named_figures(const Measures& measures);

/// Returns a JSON object, of a class such as nlohmann's, of named_figures().
template <class Json> Json json_of_measures(const Measures& measures) {
    Json json = Json::object();
    for (const auto& [name, value] : named_figures(measures)) {
        std::visit([&json, key = name](const auto& figure) { json[key] = figure; }, value);
    }
    return json;
}

} // namespace geometry
} // namespace foam
