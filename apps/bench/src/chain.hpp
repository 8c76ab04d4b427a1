// Stages one behind the other, as experiments name them.
#pragma once

#include <foam/recipe/internal/check.hpp>

#include <optional>
#include <set>
#include <string>
#include <vector>

namespace foam::inline bench::experiment {

/// A mesh loader or none, mesh filters, a spherizer or none; at least one stage.
struct Chain {
    std::string label; ///< "repair.auto + spherize.grid"
    std::optional<StageCall> loader;
    std::vector<StageCall> filters;
    std::optional<StageCall> spherizer;

    std::vector<StageCall> calls() const;
};

/// Which kinds of stages a list may hold.
struct ChainRule {
    bool loader = false, filters = false, spherizer = false;
    const char* wanted; ///< for messages: "mesh filters"
};

/// A stage "repair.auto", {repair.auto: {…}}, or a list of such. Nothing after a finding. `list`: the key it stands
/// under.
std::optional<Chain> read_chain(const reading::Value& value, const std::string& list, const ChainRule& rule,
                                const reading::Checking& checking);

/// A list of chains, of different labels: where the stages alone do not tell them apart, labels name the parameters.
std::vector<Chain> read_chains(const reading::Value& value, const std::string& list, const ChainRule& rule,
                               const reading::Checking& checking);

/// "repair.watertight (leaves: 10000)": a stage with the parameters that are given.
std::string text_of(const StageCall& call);

void add_names(const Chain& chain, std::set<std::string>& names);

} // namespace foam::bench::experiment
