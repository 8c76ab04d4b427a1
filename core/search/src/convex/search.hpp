// The search for covering elements of any kinds.
#pragma once

#include <foam/search/cover.hpp>

#include <memory>

namespace foam::inline search::convex {

/// As CoverSearch; by planes that cut the solid, and fits of elements to the parts.
class Search {
public:
    Search(const Solid& solid, const CoverOptions& options);
    ~Search();

    Cover cover(std::size_t count);

private:
    struct Data;
    std::unique_ptr<Data> data_;
};

} // namespace foam::inline search::convex
