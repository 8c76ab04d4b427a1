#include "cover/search.hpp"

#include <foam/error.hpp>

#include <algorithm>

namespace foam {

struct CoverSearch::Data {
    Data(const Solid& solid, const SpherizeOptions& options) : search(solid, options) {}
    cover::Search search;
};

CoverSearch::CoverSearch(const Solid& solid, const SpherizeOptions& options)
    : data_(std::make_unique<Data>(solid, options)) {}

CoverSearch::~CoverSearch() = default;

static void check(std::size_t count) {
    if (count == 0) {
        throw Error(ErrorCode::usage,
                    "spherize: a cover needs at least 1 sphere, got a count of 0; remedy: ask for 1 or more");
    }
}

Cover CoverSearch::cover(std::size_t count) {
    check(count);
    return data_->search.cover(count);
}

std::vector<Cover> spherize_each(const Solid& solid, std::span<const std::size_t> counts,
                                 const SpherizeOptions& options) {
    std::for_each(counts.begin(), counts.end(), check);
    CoverSearch search(solid, options);
    std::vector<Cover> covers;
    for (const std::size_t count : counts) {
        covers.push_back(search.cover(count));
    }
    return covers;
}

Cover spherize(const Solid& solid, std::size_t count, const SpherizeOptions& options) {
    return spherize_each(solid, {&count, 1}, options).front();
}

Cover spherize(const Mesh& mesh, std::size_t count, const SpherizeOptions& options) {
    return spherize(*Solid::make(mesh), count, options);
}

} // namespace foam
