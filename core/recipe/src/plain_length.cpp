#include "plain_length.hpp"

#include "format.hpp"

#include <foam/base/text.hpp>
#include <foam/geometry/length.hpp>
#include <foam/recipe/internal/keys.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace foam::inline recipe {
namespace reading {
namespace {

/// Returns the keys of a recipe, of its budget and of its links.
std::vector<Parameter> keys_of_recipes() {
    std::vector<Parameter> keys = declarations_of(top_level_keys());
    for (const std::vector<Parameter>& more : {declarations_of(budget_keys()), declarations_of(link_keys())}) {
        keys.insert(keys.end(), more.begin(), more.end());
    }
    return keys;
}

class Lengths {
public:
    explicit Lengths(const Registry& registry) : registry_(registry) {}

    /// Adds the lengths among the keys of a map, and of the maps and lists in it. `owner`: " of STAGE", or empty.
    void add(const Value& value, const std::vector<Parameter>& declared, const std::string& owner) {
        for (std::size_t i = 0; i < value.items.size(); ++i) {
            const Value& item = value.items[i];
            if (value.is(Value::Kind::list)) {
                add(item, declared, owner);
            } else if (item.is(Value::Kind::integer) || item.is(Value::Kind::number)) {
                add_number(value.keys[i].text, item, declared, owner);
            } else {
                add_below(value.keys[i].text, item);
            }
        }
    }

    std::vector<PlainLength> found;

private:
    void add_number(const std::string& name, const Value& item, const std::vector<Parameter>& declared,
                    const std::string& owner) {
        const auto parameter =
            std::find_if(declared.begin(), declared.end(), [&](const Parameter& p) { return p.name == name; });
        if (parameter != declared.end() && is_length(*parameter)) {
            const double metres = item.is(Value::Kind::integer) ? static_cast<double>(item.whole) : item.real;
            found.push_back({name + owner, metres});
        }
    }

    void add_below(const std::string& key, const Value& item) {
        if (const RegisteredStage* stage = registry_.find(key)) {
            add(item, stage->info.parameters, " of " + key);
        } else if (key == "clip") {
            add(item, clip_values(), " of clip");
        } else {
            add(item, keys_, "");
        }
    }

    const Registry& registry_;
    const std::vector<Parameter> keys_ = keys_of_recipes();
};

} // namespace

std::vector<PlainLength> plain_lengths(const Value& root, const Registry& registry) {
    Lengths lengths(registry);
    lengths.add(root, keys_of_recipes(), "");
    return std::move(lengths.found);
}

} // namespace reading

std::string question_about(const PlainLength& length, double size, std::string_view of) {
    if (!(size > 0) || !(std::abs(length.metres) > size)) {
        return "";
    }
    return fmt::format("{} is {}, larger than {} ({}){}; if it is in millimetres: {}mm", length.name,
                       length_text(length.metres), of, length_text(size),
                       length.name == "max_protrusion" ? ": it has no effect" : "", number_text(length.metres));
}

} // namespace foam::inline recipe
