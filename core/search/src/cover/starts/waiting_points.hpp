// Points that join a descent once it leaves them outside.
#pragma once

#include "cover/measured/points.hpp"

#include <cstdint>
#include <optional>

namespace foam::inline search::cover {

/// Points outside the active set of a descent. Only few of many points ever matter to a descent; the others are checked
/// now and then (active sets).
class WaitingPoints {
public:
    /// `begin`: the first of `all` that is not among the descent's points from the start. `all` must outlive this.
    WaitingPoints(const Points& all, std::size_t begin);

    /// Moves the points outside all balls to `active`.
    void add_outside(const Balls& balls, Points& active);

private:
    struct Waiting {
        std::uint32_t point, owner; ///< the last ball that contained it
    };
    std::optional<std::uint32_t> owner_of(const Waiting& waiting, const Balls& balls) const;

    const Points& all_;
    std::vector<Waiting> waiting_;
};

} // namespace foam::inline search::cover
