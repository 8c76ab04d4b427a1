#include "chain.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace foam::inline bench::experiment {
namespace {

using namespace reading;

std::string label_of(const Chain& chain, bool parameters) {
    std::string label;
    for (const StageCall& call : chain.calls()) {
        label += label.empty() ? "" : " + ";
        label += parameters ? text_of(call) : call.stage;
    }
    return label;
}

/// Adds a stage to the chain; false after a finding.
bool add_stage(const Value& value, const std::string& list, const ChainRule& rule, const Checking& checking,
               Chain& chain) {
    StageItem item = read_stage_item(value, list, checking);
    read_stage_parameters(item, {}, checking);
    if (!item.stage) {
        return false;
    }
    const auto refuse = [&](const std::string& code, const std::string& why) {
        checking.findings.error(item.name.where, code, fmt::format("{} {}", in_quotes(item.call.stage), why));
        return false;
    };
    if (item.call.isolation != Isolation{}) {
        return refuse("unsupported", "is measured in this process; remedy: delete isolate, time_limit, memory_limit");
    }
    const StageKind kind = item.stage->kind;
    const bool loader = kind == StageKind::mesh_loader, filter = kind == StageKind::mesh_filter,
               spherizer = kind == StageKind::spherizer;
    if (!(loader && rule.loader) && !(filter && rule.filters) && !(spherizer && rule.spherizer)) {
        return refuse("wrong-kind", fmt::format("is a {}; '{}' holds {}", to_string(kind), list, rule.wanted));
    }
    if (chain.spherizer) {
        return refuse("wrong-kind", fmt::format("stands behind the spherizer '{}'; remedy: move it before that",
                                                chain.spherizer->stage));
    }
    if (loader && !chain.calls().empty()) {
        return refuse("wrong-kind", "is a mesh loader behind another stage; remedy: make it the first");
    }
    if (filter) {
        chain.filters.push_back(std::move(item.call));
    } else {
        (loader ? chain.loader : chain.spherizer) = std::move(item.call);
    }
    return true;
}

} // namespace

std::vector<StageCall> Chain::calls() const {
    std::vector<StageCall> all;
    if (loader) {
        all.push_back(*loader);
    }
    all.insert(all.end(), filters.begin(), filters.end());
    if (spherizer) {
        all.push_back(*spherizer);
    }
    return all;
}

std::optional<Chain> read_chain(const Value& value, const std::string& list, const ChainRule& rule,
                                const Checking& checking) {
    const std::vector<Value> one = {value};
    const std::vector<Value>& items = value.is(Value::Kind::list) ? value.items : one;
    if (items.empty()) {
        checking.findings.error(value.where, "wrong-type", fmt::format("an item of '{}' is an empty list", list));
    }
    Chain chain;
    bool good = !items.empty();
    for (const Value& item : items) {
        good = add_stage(item, list, rule, checking, chain) && good;
    }
    chain.label = label_of(chain, false);
    return good ? std::optional(std::move(chain)) : std::nullopt;
}

std::vector<Chain> read_chains(const Value& value, const std::string& list, const ChainRule& rule,
                               const Checking& checking) {
    std::vector<Chain> chains;
    if (!expect_list(value, list, fmt::format("{}: [STAGE, …]", list), checking.findings)) {
        return chains;
    }
    if (value.items.empty()) {
        checking.findings.error(value.where, "wrong-type", fmt::format("'{}' expects at least one stage", list));
    }
    for (const Value& item : value.items) {
        if (auto chain = read_chain(item, list, rule, checking)) {
            chains.push_back(std::move(*chain));
            const Chain& last = chains.back();
            const bool twice = std::any_of(chains.begin(), chains.end() - 1, [&](const Chain& other) {
                return label_of(other, true) == label_of(last, true);
            });
            if (twice) {
                checking.findings.error(
                    item.where, "duplicate-value",
                    fmt::format("{} is in '{}' twice; remedy: delete one", in_quotes(label_of(last, true)), list));
            }
        }
    }
    std::multiset<std::string> labels;
    for (const Chain& chain : chains) {
        labels.insert(chain.label);
    }
    for (Chain& chain : chains) {
        chain.label = label_of(chain, labels.count(chain.label) > 1);
    }
    return chains;
}

std::string text_of(const StageCall& call) {
    std::vector<std::string> texts;
    for (const auto& [name, value] : call.given) {
        texts.push_back(fmt::format("{}: {}", name, to_text(value)));
    }
    return texts.empty() ? call.stage : fmt::format("{} ({})", call.stage, fmt::join(texts, ", "));
}

void add_names(const Chain& chain, std::set<std::string>& names) {
    for (const StageCall& call : chain.calls()) {
        names.insert(call.stage);
    }
}

} // namespace foam::bench::experiment
