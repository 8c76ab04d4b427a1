// What is asked: environments and configurations, the same for every engine.
#pragma once

#include "engine.hpp"
#include "environment.hpp"
#include "robots.hpp"

namespace foam::inline bench {

struct QueryCounts {
    std::size_t queries = 0;
    std::size_t environments = 0;
};

/// Any part of it is the same whatever other part was made before.
class QueryPlan {
public:
    QueryPlan(const TwoModels& models, const EnvironmentRule& rule, const QueryCounts& counts, std::uint64_t seed);
    const std::vector<std::vector<Obstacle>>& environments() const { return environments_; }
    /// Query i is in environment i · environments / queries; its configuration is uniform within the limits.
    /// `distances` of all queries, evenly spread, ask for distances too.
    std::vector<EngineQuery> queries(std::size_t first, std::size_t count, std::size_t distances) const;

private:
    const TwoModels& models_;
    QueryCounts counts_;
    std::uint64_t seed_;
    std::vector<std::vector<Obstacle>> environments_;
};

} // namespace foam::bench
