#include <foam/base/error.hpp>
#include <foam/recipe/internal/glob.hpp>
#include <foam/recipe/internal/keys.hpp>
#include <foam/recipe/recipe.hpp>

#include <fmt/format.h>

namespace foam::inline recipe {
namespace {

/// Returns the length of the set "[a-z]" at the front of `glob`, 0 if it is not closed. `found`: whether it contains
/// `c`.
std::size_t match_set(std::string_view glob, char c, bool& found) {
    const std::size_t close = glob.find(']', 2); // a ']' right behind '[' is a member
    if (close == std::string_view::npos) {
        return 0;
    }
    const bool negated = glob[1] == '!' || glob[1] == '^';
    found = false;
    for (std::size_t i = negated ? 2 : 1; i < close; ++i) {
        if (i + 2 < close && glob[i + 1] == '-') {
            found = found || (glob[i] <= c && c <= glob[i + 2]);
            i += 2;
        } else {
            found = found || glob[i] == c;
        }
    }
    found = found != negated;
    return close + 1;
}

/// Returns the length of the pattern element at the front of `glob` if it matches the character `c`, else 0.
std::size_t match_one(std::string_view glob, char c) {
    if (glob.empty() || glob.front() == '*') {
        return 0;
    }
    if (glob.front() == '[') {
        bool found = false;
        const std::size_t length = match_set(glob, c, found);
        return found ? length : 0;
    }
    return glob.front() == '?' || glob.front() == c ? 1 : 0;
}

void merge(StageCall& call, const LinkOverride& link) {
    for (const StageCall& change : link.stages) {
        if (change.stage == call.stage) {
            for (const auto& [name, value] : change.given) {
                call.given[name] = value;
            }
            call.isolation = change.isolation.over(call.isolation);
        }
    }
}

} // namespace

bool glob_matches(std::string_view glob, std::string_view name) {
    // One '*' is kept: if the rest fails, it matches one more character. Quadratic at worst.
    std::size_t g = 0, n = 0, star = std::string_view::npos, star_n = 0;
    while (n < name.size()) {
        if (const std::size_t length = match_one(glob.substr(g), name[n])) {
            g += length;
            ++n;
        } else if (g < glob.size() && glob[g] == '*') {
            star = g++;
            star_n = n;
        } else if (star != std::string_view::npos) {
            g = star + 1;
            n = ++star_n;
        } else {
            return false;
        }
    }
    return glob.find_first_not_of('*', g) == std::string_view::npos;
}

std::string glob_of_name(const std::string& name) {
    std::string glob;
    for (const char c : name) {
        glob += c == '*' || c == '?' || c == '[' ? std::string{'[', c, ']'} : std::string{c};
    }
    return glob;
}

Numbers Recipe::proved_numbers(const Registry& registry) const {
    const bool single = std::any_of(outputs.begin(), outputs.end(), [&](const OutputCall& output) {
        const RegisteredStage* writer = registry.find(output.writer.stage);
        return writer && writer->info.consumer.float32;
    });
    return numbers.value_or(single ? Numbers::float32 : Numbers::float64);
}

template <class Call, class Of> static std::vector<Call*> stages_of(Of& chain) {
    std::vector<Call*> stages;
    for (Call& filter : chain.filters) {
        stages.push_back(&filter);
    }
    stages.push_back(&chain.spherizer);
    for (Call& refiner : chain.refiners) {
        stages.push_back(&refiner);
    }
    return stages;
}

std::vector<const StageCall*> StageChain::stages() const {
    return stages_of<const StageCall>(*this);
}

std::vector<StageCall*> StageChain::stages() {
    return stages_of<StageCall>(*this);
}

Recipe::LinkRecipe Recipe::for_link(const std::string& link) const {
    LinkRecipe result;
    static_cast<StageChain&>(result) = *this;
    for (StageCall* stage : result.stages()) {
        stage->isolation = stage->isolation.over(isolation);
    }
    result.max_protrusion = budget_max_protrusion;
    result.pad = pad.value_or(0);
    result.hollow = hollow.value_or(Hollow::keep);
    result.covers = covers.value_or(Covers::solid);
    for (const LinkOverride& change : links) {
        // A glob also matches its own text: "[" cannot be written otherwise.
        if (change.glob != link && !glob_matches(change.glob, link)) {
            continue;
        }
        for (const reading::LinkKey& key : reading::link_keys()) {
            key.merge(change, result);
        }
        result.clip = change.clip.value_or(result.clip);
        result.keep = change.keep.value_or(result.keep);
        for (StageCall* stage : result.stages()) {
            merge(*stage, change);
        }
    }
    result.skip = result.skip || result.no_collision;
    if (result.max_spheres && *result.max_spheres < result.keep.size()) {
        throw Error(ErrorCode::recipe,
                    fmt::format("link '{}' keeps {} spheres and is to have at most {}; remedy: correct 'links'", link,
                                result.keep.size(), *result.max_spheres));
    }
    if (result.max_spheres && *result.max_spheres < result.min_spheres) {
        throw Error(ErrorCode::recipe,
                    fmt::format("link '{}' is to have at least {} and at most {} spheres; remedy: correct 'links'",
                                link, result.min_spheres, *result.max_spheres));
    }
    return result;
}

} // namespace foam::recipe
