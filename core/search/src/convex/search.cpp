#include "search.hpp"
#include "by_spheres/portfolio/problem.hpp"
#include "cells.hpp"
#include "least_fit.hpp"
#include "pieces.hpp"

#include <foam/base/error.hpp>
#include <foam/base/parallel.hpp>
#include <foam/geometry/internal/own_frame.hpp>
#include <foam/geometry/internal/proof.hpp>
#include <foam/geometry/measure.hpp>
#include <foam/search/cover.hpp>
#include <foam/search/least_element.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <map>
#include <tuple>

namespace foam::inline search {
namespace convex {

namespace {

using Kind = Element::Kind;

PartitionPlan plan_for(Effort effort) {
    switch (effort) {
    case Effort::fast:
        return {80, 32, {.sweeps = 1, .tries = 12, .split_tries = 9}};
    case Effort::normal:
        return {120, 40, {.sweeps = 2, .tries = 18, .split_tries = 18}};
    case Effort::best:
        break;
    }
    return {600, 160, {.sweeps = 20, .tries = 60, .split_tries = 30}};
}

void keep_each_once(std::vector<Vec3>& points) {
    const auto key = [](const Vec3& p) { return std::tie(p.x, p.y, p.z); };
    std::sort(points.begin(), points.end(), [&](const Vec3& a, const Vec3& b) { return key(a) < key(b); });
    points.erase(std::unique(points.begin(), points.end()), points.end());
}

/// Returns the points of a piece whose hull has all of the body in it, each once: those of the surface, and the corners
/// of its regions that are inside.
std::vector<Vec3> points_of(const Partition& partition, const Piece& piece, const Body& body) {
    std::vector<Vec3> points;
    for (const std::uint32_t i : piece.bricks) {
        const Brick& brick = partition.bricks[i];
        points.insert(points.end(), brick.surface.corners.begin(), brick.surface.corners.end());
        for (const Region& region : brick.regions) {
            add_corners_inside(body, region.corners, points);
        }
    }
    keep_each_once(points); // most are corners of several triangles
    return points;
}

Elements all_grown(const std::vector<Element>& elements, double length) {
    Elements result;
    for (const Element& element : elements) {
        result.add(grown(element, length));
    }
    return result;
}

/// Returns the count whose elements those of a count of at least 2 are compared with: the largest one below of 1, 2, 4,
/// 8, 16, 64, 256…
std::size_t rung_below(std::size_t count) {
    constexpr std::size_t few = 32;
    const std::size_t octave = std::bit_floor(count - 1);
    const bool between = octave >= few && std::countr_zero(octave) % 2 == 1;
    return between ? octave / 2 : octave;
}

} // namespace

struct Search::Data {
    Data(const Solid& given, const CoverOptions& given_options)
        : solid(given), kinds(given_options.kinds), options(given_options), plan(plan_for(options.effort)) {
        std::sort(kinds.begin(), kinds.end());
        kinds.erase(std::unique(kinds.begin(), kinds.end()), kinds.end());
        if (options.max_vertices < 4) {
            throw Error(ErrorCode::usage, fmt::format("cover: a hull has at least 4 vertices, got a limit of {}; "
                                                      "remedy: allow 4 or more",
                                                      options.max_vertices));
        }
        if (const std::string why = geometry::why_out_of_bounds(solid.bounds()); !why.empty()) {
            throw Error(ErrorCode::geometry, "cover: the solid cannot be covered: " + why);
        }
        only_hulls = kinds == std::vector{Element::Kind::hull};
        if (has(Element::Kind::hull) && options.effort != Effort::best) { // whose first cuts tell what they save
            plan.recut.tries = 12;
            plan.recut.split_tries = 6;
        }
    }

    /// A cover and the figure that is compared, once that is needed.
    struct Rated {
        Cover cover;
        std::optional<double> figure;
    };
    /// Returns the best cover of at most `count` elements.
    Rated best_of(std::size_t count) {
        if (const auto found = known.find(count); found != known.end()) {
            return found->second;
        }
        std::optional<Rated> best;
        const bool done = by_spheres::completed_unless_stopped(options.stop, [&] {
            if (count > 1) {
                best = best_of(rung_below(count));
            }
            if (Data* quicker = with_less_effort()) { // more effort is never worse
                Rated found = quicker->best_of(count);
                best ? take_better(*best, std::move(found)) : void(best = std::move(found));
            }
            Rated found = count > 1 ? several(count) : single();
            best ? take_better(*best, std::move(found)) : void(best = std::move(found));
        });
        if (!best) {
            best = Rated{single(Effort::fast), {}};
        }
        if (done) {
            known.emplace(count, *best);
        }
        return *best;
    }

    /// Returns the same search with less effort; null if there is none.
    Data* with_less_effort() {
        if (options.effort == Effort::fast) {
            return nullptr;
        }
        if (!quicker_) {
            CoverOptions less = options;
            less.effort = options.effort == Effort::best ? Effort::normal : Effort::fast;
            quicker_ = std::make_unique<Data>(solid, less);
        }
        return quicker_.get();
    }

    bool has(Element::Kind kind) const { return std::find(kinds.begin(), kinds.end(), kind) != kinds.end(); }

    /// Returns the quick fit of least volume of any of the kinds around points in units.
    Fit quick_fit_around(const std::vector<Vec3>& points) const {
        Cloud cloud;
        cloud.points = points;
        cloud.normals = flush;
        std::optional<Fit> best;
        for (const Element::Kind kind : kinds) {
            const Fit fit = quick_fit(kind, cloud, options.axis_aligned);
            if (!best || volume(fit) < volume(*best)) {
                best = fit;
            }
        }
        return *best;
    }
    const by_spheres::Occupancy& occupancy() {
        constexpr int resolution = 48;
        if (!occupancy_) {
            occupancy_.emplace(solid, by_spheres::Frame(solid.bounds()), resolution);
        }
        return *occupancy_;
    }
    const Pricing& pricing() {
        if (!pricing_ && has(Element::Kind::hull)) {
            pricing_ = std::make_unique<SumOfHulls>();
        } else if (!pricing_) {
            const auto fit_around = [this](std::span<const Vec3> points) {
                return quick_fit_around(few_extremes_of(points));
            };
            pricing_ = std::make_unique<VolumeOutside>(occupancy(), fit_around, solid.volume() > 0);
        }
        return *pricing_;
    }
    Element hull_of(const std::vector<Vec3>& points) const {
        return hull_around(points, solid.bounds().diagonal(), options.max_vertices);
    }
    /// Returns the element of least volume of any of the kinds around points in metres.
    Element element_around(const std::vector<Vec3>& points, Effort effort) const {
        std::optional<Element> best;
        std::optional<Cloud> cloud;
        for (const Element::Kind kind : kinds) {
            Element element;
            if (kind == Element::Kind::hull) {
                element = hull_of(points);
            } else {
                if (!cloud) {
                    cloud = effort == Effort::fast ? quick_cloud_of(points) : cloud_of(points);
                }
                element = element_of(least_fit(kind, *cloud, effort, options.axis_aligned), *cloud);
            }
            if (!best || volume(element) < volume(*best)) {
                best = std::move(element);
            }
        }
        return std::move(*best);
    }
    /// Returns one element: that of the quick search, or a better one.
    Rated single() const {
        Rated best{single(Effort::fast), {}};
        if (options.effort != Effort::fast && !only_hulls) { // a hull is a hull
            take_better(best, {single(options.effort), {}});
            if (options.objective != Objective::excess) {
                take_less_protruding(best);
            }
        }
        return best;
    }
    /// Takes the element of any one of the kinds if it protrudes less.
    void take_less_protruding(Rated& best) const {
        const std::vector<Vec3>& points = solid.surface().vertices;
        const Cloud cloud = cloud_of(points);
        for (const Element::Kind kind : kinds) {
            Elements level;
            if (kind == Element::Kind::hull) {
                level.add(hull_of(points));
            } else {
                const Fit fit = kind == Element::Kind::sphere ? least_sphere(cloud)
                                                              : least_protrusion(kind, cloud, solid, options.objective,
                                                                                 options.effort, options.axis_aligned);
                level.add(element_of(fit, cloud));
            }
            take_better(best, {proved(solid, std::move(level)), {}});
        }
    }
    Cover single(Effort effort) const {
        Elements level;
        level.add(element_around(solid.surface().vertices, effort));
        return proved(solid, std::move(level));
    }
    /// Sets the normals of a few large faces, which boxes may lie flush with.
    void set_flush() {
        constexpr std::size_t most = 3;
        constexpr double same = 0.999; // cosine
        for (const Plane& face : body_->body.faces) {
            const bool known = std::any_of(flush.begin(), flush.end(),
                                           [&](const Vec3& n) { return std::abs(dot(n, face.normal)) > same; });
            if (!known && flush.size() < most) {
                flush.push_back(face.normal);
            }
        }
    }
    const BodyOfSolid& body() {
        if (!body_) {
            body_ = body_of(solid);
            body_->body.is_filled = body_->body.is_filled || (only_hulls && body_->body.has_inside);
            set_flush();
        }
        return *body_;
    }
    /// Returns an element around each piece that has a part of the body.
    std::vector<Element> elements_of(const Partition& partition, Effort effort) {
        const BodyOfSolid& all = body();
        std::vector<std::optional<Element>> found(partition.pieces.size());
        parallel_for(found.size(), [&](std::size_t i) {
            std::vector<Vec3> points = points_of(partition, partition.pieces[i], all.body);
            for (Vec3& p : points) {
                p = all.origin + p * all.unit;
            }
            if (!points.empty()) {
                found[i] = element_around(points, effort);
            }
        });
        std::vector<Element> elements;
        for (std::optional<Element>& element : found) {
            if (element) {
                elements.push_back(std::move(*element));
            }
        }
        return elements;
    }
    bool has_round_parts() const {
        return std::any_of(solid.parts().begin(), solid.parts().end(), [](const Solid::Part& part) {
            return part.primitive && part.primitive->kind != Element::Kind::box;
        });
    }
    /// Returns the cover by elements of pieces that meet in planes.
    Cover cover_by(const std::vector<Element>& elements) {
        // They cover with numbers of six digits, too. What this adds to slivers counts. The proof halves the surfaces
        // of round primitives down to the overlap, but cuts triangles along the elements.
        constexpr double usual = 1e-6, of_round_parts = 3e-4, of_thin = 1e-10; // of the size
        constexpr double thin = 3e-2, flat = 1e-5;
        const double unit = body().unit;
        if (has_round_parts()) {
            return proved(solid, all_grown(elements, of_round_parts * unit));
        }
        const auto is_thin = [&](const Element& element) {
            const double share = thickness(element) / unit;
            return share < thin && share > flat;
        };
        if (std::any_of(elements.begin(), elements.end(), is_thin)) {
            Cover cover; // the usual overlap adds too much to sheets
            cover.elements = all_grown(elements, of_thin * unit);
            cover.certificate = geometry::certify_to_first_gap(solid, cover.elements);
            if (cover.certificate.holds) {
                return cover;
            }
        }
        return proved(solid, all_grown(elements, usual * unit));
    }
    std::vector<Element> descended(const std::vector<Element>& elements) {
        const BodyOfSolid& all = body();
        std::vector<Fit> fits;
        for (const Element& element : elements) {
            fits.push_back(fit_of(element, all.origin, all.unit));
        }
        fits = descended_together(all.body, occupancy(), std::move(fits), options.effort, options.axis_aligned);
        Cloud frame;
        frame.origin = all.origin;
        frame.unit = all.unit;
        std::vector<Element> result;
        for (const Fit& fit : fits) {
            result.push_back(element_of(fit, frame));
        }
        return result;
    }
    Rated cover_of(const Partition& partition) {
        if (has(Element::Kind::hull)) {
            return {cover_by(elements_of(partition, options.effort)), {}};
        }
        const std::vector<Element> start = elements_of(partition, Effort::fast);
        Rated best{cover_by(descended(start)), {}};
        const bool descends_by_figure = options.objective == Objective::excess && solid.volume() > 0;
        if (!descends_by_figure || body().body.is_filled) { // growth of what the descent left open may take it all back
            take_better(best, {cover_by(start), {}});
        }
        return best;
    }
    /// Returns the volume of the element around points.
    double price_of_one(std::span<const Vec3> points) const {
        return has(Element::Kind::hull) ? volume_of_hull(points) : volume(quick_fit_around(few_extremes_of(points)));
    }
    Partitions& partitions() {
        if (!partitions_) {
            partitions_.emplace(
                body().body, pricing(), [this](std::span<const Vec3> points) { return price_of_one(points); },
                only_hulls, plan);
        }
        return *partitions_;
    }
    /// Returns an element around each part of the solid. A part that is an element of one of the kinds stays what it is.
    std::vector<Element> elements_of_parts() const {
        const std::vector<Solid::Part>& parts = solid.parts();
        const std::span<const std::uint32_t> offsets = solid.part_offsets();
        const Mesh& surface = solid.surface();
        std::vector<Element> elements(parts.size());
        parallel_for(parts.size(), [&](std::size_t i) {
            if (parts[i].primitive && has(parts[i].primitive->kind) && !options.axis_aligned) {
                elements[i] = moved(*parts[i].primitive, parts[i].pose);
                return;
            }
            std::vector<Vec3> points;
            for (std::uint32_t t = offsets[i]; t < offsets[i + 1]; ++t) {
                for (const std::uint32_t corner : surface.triangles[t]) {
                    points.push_back(surface.vertices[corner]);
                }
            }
            elements[i] = element_around(points, options.effort);
        });
        return elements;
    }
    /// Returns the cover by these elements; null where there is one part, or more than `count`.
    Rated* by_parts(std::size_t count) {
        if (solid.parts().size() < 2 || solid.parts().size() > count) {
            return nullptr;
        }
        if (!by_parts_) {
            by_parts_ = Rated{cover_by(elements_of_parts()), {}};
        }
        return &*by_parts_;
    }
    Rated several(std::size_t count) {
        constexpr double exact = 1e-3; // of the volume, which is measured along lines where parts overlap
        Rated* parts = by_parts(count);
        if (parts && options.objective == Objective::excess && figure(*parts) <= exact * solid.volume()) {
            return *parts;
        }
        Rated found = cover_of(partitions().best(count));
        if (parts) {
            take_better(found, *parts);
        }
        return found;
    }
    double figure(Rated& rated) const {
        if (!rated.figure) {
            rated.figure = figure_of(solid, rated.cover, options.objective);
        }
        return *rated.figure;
    }
    void take_better(Rated& best, Rated other) const {
        constexpr double rounding = 1e-8; // of the volume, along lines
        const double least_gain = options.objective == Objective::excess ? rounding * solid.volume() : 0;
        if (figure(other) < figure(best) - least_gain) {
            best = std::move(other);
        }
    }

    const Solid& solid;
    std::vector<Element::Kind> kinds;
    CoverOptions options;
    PartitionPlan plan;
    bool only_hulls = false;
    std::vector<Vec3> flush; ///< normals, once body() is known
    std::optional<by_spheres::Occupancy> occupancy_;
    std::unique_ptr<Pricing> pricing_;
    std::unique_ptr<Data> quicker_;
    std::optional<BodyOfSolid> body_;
    std::optional<Partitions> partitions_;
    std::optional<Rated> by_parts_;
    std::map<std::size_t, Rated> known;
};

Search::Search(const Solid& solid, const CoverOptions& options) : data_(std::make_unique<Data>(solid, options)) {}

Search::~Search() = default;

Cover Search::cover(std::size_t count) {
    Cover cover = data_->best_of(count).cover;
    cover.volume = union_volume(cover.elements);
    return cover;
}

} // namespace convex

Element least_element(Element::Kind kind, std::span<const Vec3> points, Effort effort, bool axis_aligned) {
    if (points.empty()) {
        throw Error(ErrorCode::geometry, "an element around no points; remedy: give one or more");
    }
    if (!std::all_of(points.begin(), points.end(), [](const Vec3& p) { return is_finite(p); })) {
        throw Error(ErrorCode::geometry, "an element needs points with finite coordinates");
    }
    const convex::Cloud cloud = convex::cloud_of(points);
    if (kind == Element::Kind::hull) {
        return convex::hull_around({points.begin(), points.end()}, cloud.unit, points.size());
    }
    return convex::element_of(convex::least_fit(kind, cloud, effort, axis_aligned), cloud);
}

} // namespace foam::inline search
