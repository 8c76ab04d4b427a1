// The one search behind all names: spheres alone have their own, every other choice of kinds another.
#include "by_spheres/portfolio/searches.hpp"
#include "by_spheres/portfolio/seen_search.hpp"
#include "convex/least_fit.hpp"
#include "convex/search.hpp"

#include <foam/base/error.hpp>
#include <foam/geometry/solid_of_balls.hpp>
#include <foam/geometry/volumes.hpp>
#include <foam/search/spherize.hpp>

#include <algorithm>
#include <optional>
#include <variant>
#include <vector>

namespace foam::inline search {
namespace {

bool spheres_alone(const CoverOptions& options) {
    return !options.kinds.empty() &&
           std::all_of(options.kinds.begin(), options.kinds.end(),
                       [](Element::Kind kind) { return kind == Element::Kind::sphere; }) &&
           options.objective != Objective::mean_protrusion;
}

/// Throws Error(usage) for options that no search takes.
void check(const CoverOptions& options) {
    if (options.kinds.empty()) {
        throw Error(ErrorCode::usage, "cover: there is no kind of element to use; remedy: name one or more");
    }
    if (options.objective == Objective::radius && !spheres_alone(options)) {
        throw Error(ErrorCode::usage, "cover: only spheres are searched for the least largest radius; remedy: spheres "
                                      "alone, or another objective");
    }
}

Cover cover_of(SphereCover found) {
    return {std::move(found.spheres), found.certificate, found.volume};
}

} // namespace

std::optional<Effort> effort_named(std::string_view word) {
    return word == "fast"     ? std::optional(Effort::fast)
           : word == "normal" ? std::optional(Effort::normal)
           : word == "best"   ? std::optional(Effort::best)
                              : std::nullopt;
}

struct CoverSearch::Data {
    std::variant<std::monostate, by_spheres::SolidSearch, convex::Search> search;
};

CoverSearch::CoverSearch(const Solid& solid, const CoverOptions& options) : data_(std::make_unique<Data>()) {
    check(options);
    if (spheres_alone(options)) {
        data_->search.emplace<by_spheres::SolidSearch>(solid, options);
    } else {
        data_->search.emplace<convex::Search>(solid, options);
    }
}

CoverSearch::~CoverSearch() = default;

Cover CoverSearch::cover(std::size_t count) {
    if (count == 0) {
        throw Error(ErrorCode::usage,
                    "a cover needs at least 1 element, got a count of 0; remedy: ask for 1 or more");
    }
    if (auto* const spheres = std::get_if<by_spheres::SolidSearch>(&data_->search)) {
        return cover_of(spheres->cover(count));
    }
    return std::get<convex::Search>(data_->search).cover(count);
}

Cover cover(const Solid& solid, std::size_t count, const CoverOptions& options) {
    check(options);
    const bool may_be_spheres =
        std::find(options.kinds.begin(), options.kinds.end(), Element::Kind::sphere) != options.kinds.end();
    if (may_be_spheres && options.objective != Objective::radius) { // smaller balls may cover a large one
        if (std::optional<std::vector<Sphere>> balls = balls_of(solid, count)) {
            Cover found = convex::proved(solid, std::move(*balls));
            found.volume = exact_union_volume(found.elements.spheres());
            return found;
        }
    }
    if (count > 0 && spheres_alone(options)) { // with effort fast: for this count alone
        return cover_of(spherize(solid, count, options));
    }
    return CoverSearch(solid, options).cover(count);
}

Cover cover(const Mesh& mesh, std::size_t count, const CoverOptions& options) {
    return cover(*Solid::make(mesh), count, options);
}

Cover cover(std::span<const Sphere> balls, std::size_t count, const CoverOptions& options) {
    check(options);
    if (spheres_alone(options) && options.objective == Objective::excess) {
        if (std::optional<SphereCover> seen = by_spheres::cover_of_seen(balls, count, options)) {
            return cover_of(std::move(*seen));
        }
    }
    return cover(*solid_of_balls(balls), count, options);
}

} // namespace foam::inline search
