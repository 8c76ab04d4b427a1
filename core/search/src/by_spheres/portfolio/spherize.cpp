#include "by_spheres/portfolio/problem.hpp"
#include "by_spheres/portfolio/quick_search.hpp"
#include "by_spheres/portfolio/search.hpp"
#include "by_spheres/portfolio/searches.hpp"

#include <foam/base/error.hpp>
#include <foam/geometry/internal/own_frame.hpp>
#include <foam/geometry/internal/solids.hpp>
#include <foam/geometry/volumes.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <variant>

namespace foam::inline search {

/// The solid in the frame of the computation: its own frame if its size or place is out of the ordinary.
class WorkedOn {
public:
    explicit WorkedOn(const Solid& solid) : given_(solid), frame_(geometry::own_frame(solid)) {
        if (const std::string why = why_not(solid.bounds()); !why.empty()) {
            throw Error(ErrorCode::geometry, "spherize: the solid cannot be covered: " + why);
        }
        if (!frame_.is_given()) {
            own_ = frame_.to_own(solid);
        }
    }
    const Solid& solid() const { return own_ ? *own_ : given_; }
    /// Returns a cover of solid() as a cover of the given solid, proved there.
    SphereCover in_given_frame(SphereCover cover) const {
        if (own_) {
            cover.spheres = grown_to_cover(given_, frame_.from_own(std::move(cover.spheres)));
            cover.certificate = certify(given_, cover.spheres);
            cover.volume = exact_union_volume(cover.spheres);
        }
        return cover;
    }

private:
    /// Returns why spheres cannot be computed for geometry in the box; empty if they can.
    static std::string why_not(const Box& box) {
        if (geometry::size_of(box) > 0) {
            return geometry::why_out_of_bounds(box);
        }
        // For a point a tiny sphere is enough.
        const double away = std::max({std::abs(box.low.x), std::abs(box.low.y), std::abs(box.low.z)});
        return away <= geometry::largest_size
                   ? ""
                   : fmt::format("its only point is {:.3g} m from the origin of its frame, more than {:g} m; remedy: "
                                 "check its unit and scale",
                                 away, geometry::largest_size);
    }

    const Solid& given_;
    geometry::OwnFrame frame_;
    std::shared_ptr<const Solid> own_;
};

/// The search for the given objective and effort, on a solid in its frame.
class SearchAsIs {
public:
    SearchAsIs(const Solid& solid, const CoverOptions& options) {
        if (options.objective != Objective::excess) {
            search_.emplace<by_spheres::ObjectiveSearch>(solid, options);
        } else if (options.effort == Effort::fast) {
            search_.emplace<by_spheres::QuickSearch>(solid, options);
        } else {
            search_.emplace<by_spheres::Search>(solid, options);
        }
    }
    SphereCover cover(std::size_t count) {
        if (auto* const quick = std::get_if<by_spheres::QuickSearch>(&search_)) {
            return quick->cover(count);
        }
        if (auto* const other = std::get_if<by_spheres::ObjectiveSearch>(&search_)) {
            return other->cover(count);
        }
        return std::get<by_spheres::Search>(search_).cover(count);
    }

private:
    std::variant<std::monostate, by_spheres::QuickSearch, by_spheres::Search, by_spheres::ObjectiveSearch> search_;
};

/// Returns the solid on which a search works if the given one has so many triangles that they would take most of the
/// time; else null. Not for other objectives, which the fit to the given solid would not keep.
static std::shared_ptr<const Solid> coarse_to_search(const Solid& solid, const CoverOptions& options) {
    return options.objective == Objective::excess ? geometry::coarse_solid(solid) : nullptr;
}

/// A search on a coarse solid, and fits of its results to the solid itself.
class CoarseToFine {
public:
    CoarseToFine(const Solid& solid, std::shared_ptr<const Solid> coarse, const CoverOptions& options)
        : solid_(solid), stop_(options.stop), coarse_(std::move(coarse)), fit_(solid, *coarse_, options.effort),
          search_(*coarse_, options, by_spheres::portfolio_of(options.effort).coarse) {
        if (options.effort == Effort::fast) {
            quick_.emplace(*coarse_, options);
        }
    }
    SphereCover cover(std::size_t count) { return fine(count).cover; }

private:
    struct Fine {
        SphereCover cover;
        double joint; ///< volume of the spheres and the solid together, m³
    };
    /// Returns the fit of the coarse cover, or that of the candidate count below if it is better. The result of a
    /// stopped search is not kept.
    Fine fine(std::size_t count) {
        if (const auto known = fine_.find(count); known != fine_.end()) {
            return known->second;
        }
        constexpr std::size_t few = 8; // spheres, for which the other search is quick on a coarse solid, and better
        const SphereCover coarse = quick_ && count > few ? quick_->cover(count) : search_.cover(count);
        Fine best{fit_.fitted(coarse.spheres), 0};
        best.joint = geometry::joint_volume(solid_, best.cover.spheres);
        const bool stopped = stop_ && stop_();
        if (count > 1 && !stopped) {
            if (Fine before = fine(quick_ ? by_spheres::quick_count_before(count) : by_spheres::count_before(count));
                before.joint <= best.joint) {
                best = std::move(before);
            }
        }
        if (!stopped) {
            fine_.emplace(count, best);
        }
        return best;
    }

    const Solid& solid_;
    std::function<bool()> stop_;
    std::shared_ptr<const Solid> coarse_;
    by_spheres::FineFit fit_;
    by_spheres::Search search_;
    std::optional<by_spheres::QuickSearch> quick_; ///< effort fast
    std::map<std::size_t, Fine> fine_;
};

/// The search on a solid in its frame, from coarse to fine if it has many triangles.
class AnySearch {
public:
    AnySearch(const Solid& solid, const CoverOptions& options) {
        if (std::shared_ptr<const Solid> coarse = coarse_to_search(solid, options)) {
            from_coarse_.emplace(solid, std::move(coarse), options);
        } else {
            as_is_.emplace(solid, options);
        }
    }
    SphereCover cover(std::size_t count) { return from_coarse_ ? from_coarse_->cover(count) : as_is_->cover(count); }

private:
    std::optional<CoarseToFine> from_coarse_;
    std::optional<SearchAsIs> as_is_;
};

namespace by_spheres {

struct SolidSearch::Data {
    Data(const Solid& given, const CoverOptions& options) : work(given), search(work.solid(), options) {}
    WorkedOn work;
    AnySearch search;
};

SolidSearch::SolidSearch(const Solid& solid, const CoverOptions& options)
    : data_(std::make_unique<Data>(solid, options)) {}

SolidSearch::~SolidSearch() = default;

SphereCover SolidSearch::cover(std::size_t count) {
    return data_->work.in_given_frame(data_->search.cover(count));
}

} // namespace by_spheres

static void check(std::size_t count) {
    if (count == 0) {
        throw Error(ErrorCode::usage,
                    "spherize: a cover needs at least 1 sphere, got a count of 0; remedy: ask for 1 or more");
    }
}

std::vector<SphereCover> spherize_each(const Solid& solid, std::span<const std::size_t> counts,
                                 const CoverOptions& options) {
    std::for_each(counts.begin(), counts.end(), check);
    by_spheres::SolidSearch search(solid, options);
    std::vector<SphereCover> covers;
    for (const std::size_t count : counts) {
        covers.push_back(search.cover(count));
    }
    return covers;
}

/// Returns the better result of two searches if the second was stopped early: `quick` is the fallback. A search that is
/// not stopped gives its usual result.
template <class Search, class Quick, class Figure>
static SphereCover quick_or_better(Quick quick, const Solid& solid, std::size_t count, const CoverOptions& options,
                             Figure figure) {
    SphereCover found = quick.alone(count);
    if (options.effort == Effort::fast || quick.was_stopped()) {
        return found;
    }
    Search search(solid, options);
    SphereCover better = search.cover(count);
    return search.was_stopped() && figure(search, found) < figure(search, better) ? found : better;
}

static SphereCover spherize_as_is(const Solid& solid, std::size_t count, const CoverOptions& options) {
    if (options.effort != Effort::fast && !options.stop) {
        return AnySearch(solid, options).cover(count);
    }
    if (const std::shared_ptr<const Solid> coarse = coarse_to_search(solid, options)) {
        return by_spheres::FineFit(solid, *coarse, options.effort).fitted(spherize_as_is(*coarse, count, options).spheres);
    }
    if (options.objective == Objective::excess) {
        return quick_or_better<by_spheres::Search>(by_spheres::QuickSearch(solid, options), solid, count, options,
                                              [](const auto&, const SphereCover& cover) { return cover.volume; });
    }
    CoverOptions fast = options;
    fast.effort = Effort::fast;
    return quick_or_better<by_spheres::ObjectiveSearch>(
        by_spheres::ObjectiveSearch(solid, fast), solid, count, options,
        [](const by_spheres::ObjectiveSearch& search, const SphereCover& cover) { return search.figure(cover); });
}

SphereCover spherize(const Solid& solid, std::size_t count, const CoverOptions& options) {
    check(count);
    const WorkedOn work(solid);
    return work.in_given_frame(spherize_as_is(work.solid(), count, options));
}

SphereCover spherize(const Mesh& mesh, std::size_t count, const CoverOptions& options) {
    return spherize(*Solid::make(mesh), count, options);
}

} // namespace foam::search
