#include <foam/recipe/internal/yaml.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace foam::inline recipe::reading {
namespace {

constexpr std::size_t most_points = 1000;

struct Axis {
    std::string path;
    std::string label; ///< in names: the last part of the path
    std::vector<Value> values;
    std::vector<std::string> texts; ///< in names: the values
};

/// Returns the text with the characters of a folder name only.
std::string safe(std::string text) {
    for (char& c : text) {
        const bool allowed = (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '.' ||
                             c == '-' || c == '+' || c == '_';
        c = allowed ? c : '_';
    }
    return text;
}

/// Returns the values as written, or their numbers from 1 if that would be long or ambiguous.
std::vector<std::string> texts_of(const std::vector<Value>& values) {
    std::vector<std::string> texts, numbers;
    bool usable = true;
    for (const Value& value : values) {
        texts.push_back(safe(value.text));
        numbers.push_back(fmt::format("{}", texts.size()));
        usable = usable && value.is_scalar() && !value.text.empty() && value.text.size() <= 40;
    }
    const bool distinct = std::set<std::string>(texts.begin(), texts.end()).size() == texts.size();
    return usable && distinct ? texts : numbers;
}

bool same(const Value& a, const Value& b) {
    return a.kind == b.kind && a.is_scalar() && a.text == b.text;
}

void check_axis(const Axis& axis, const Key& key, Findings& findings) {
    for (const char* fixed : {"foam", "name", "plugins", "sweep", "extends", "set", "variants"}) {
        if (axis.path == fixed || axis.path.starts_with(std::string(fixed) + ".")) {
            findings.error(key.where, "bad-path", fmt::format("'{}' cannot be swept; remedy: delete it", fixed));
        }
    }
    for (std::size_t i = 0; i < std::min(axis.values.size(), most_points); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            if (same(axis.values[i], axis.values[j])) {
                findings.error(axis.values[i].where, "duplicate-value",
                               fmt::format("{} is in the sweep of {} twice; remedy: delete one",
                                           axis.values[i].description(), in_quotes(axis.path)));
                break;
            }
        }
    }
}

std::vector<Axis> read_axes(const Value& sweep, Findings& findings) {
    std::vector<Axis> axes;
    for (std::size_t i = 0; i < sweep.keys.size(); ++i) {
        const Value& list = sweep.items[i];
        if (!list.is(Value::Kind::list) || list.items.empty()) {
            findings.error(
                list.where, "wrong-type",
                fmt::format("the sweep of {} expects a list of values, got {}; remedy: write budget.spheres: "
                            "[11, 22]",
                            in_quotes(sweep.keys[i].text),
                            list.is(Value::Kind::list) ? "an empty list" : list.description()));
            continue;
        }
        Axis axis{sweep.keys[i].text, "", list.items, texts_of(list.items)};
        const std::size_t dot = axis.path.rfind('.');
        axis.label = safe(axis.path.substr(dot == std::string::npos ? 0 : dot + 1));
        check_axis(axis, sweep.keys[i], findings);
        axes.push_back(std::move(axis));
    }
    std::multiset<std::string> labels;
    for (const Axis& axis : axes) {
        labels.insert(axis.label);
    }
    for (Axis& axis : axes) {
        axis.label = labels.count(axis.label) > 1 ? safe(axis.path) : axis.label;
    }
    return axes;
}

SweepPoint make_point(const Value& root, const std::vector<Axis>& axes, std::size_t number, const Registry& registry,
                      Findings& findings) {
    SweepPoint point{root, ""};
    std::vector<std::size_t> choice(axes.size());
    for (std::size_t i = axes.size(); i-- > 0;) {
        choice[i] = number % axes[i].values.size();
        number /= axes[i].values.size();
    }
    for (std::size_t i = 0; i < axes.size(); ++i) {
        const Value& value = axes[i].values[choice[i]];
        point.suffix += fmt::format("-{}={}", axes[i].label, axes[i].texts[choice[i]]);
        if (const std::string why = set_by_path(point.root, axes[i].path, value, registry); !why.empty()) {
            findings.error(value.where, "bad-path",
                           fmt::format("the sweep cannot set {}: {}", in_quotes(axes[i].path), why));
        }
    }
    return point;
}

} // namespace

std::vector<SweepPoint> expand_sweep(Value root, const Registry& registry, Findings& findings) {
    const Value* found = root.find("sweep");
    if (!found) {
        return {{std::move(root), ""}};
    }
    const Value sweep = *found;
    const Place where = root.find_key("sweep")->where;
    root.erase("sweep");
    if (!sweep.is(Value::Kind::map) || sweep.items.empty()) {
        findings.error(sweep.where, "wrong-type",
                       fmt::format("'sweep' expects a map, got {}; remedy: write sweep: {{budget.spheres: [11, 22]}}",
                                   sweep.is(Value::Kind::map) ? "an empty map" : sweep.description()));
        return {{std::move(root), ""}};
    }
    const std::vector<Axis> axes = read_axes(sweep, findings);
    std::size_t count = 1;
    for (const Axis& axis : axes) {
        count = count > most_points ? count : count * axis.values.size();
    }
    if (count > most_points) {
        findings.error(where, "too-many",
                       fmt::format("the sweep has more than {} points; remedy: split it", most_points));
        count = 1;
    }
    std::vector<SweepPoint> points;
    for (std::size_t i = 0; i < count; ++i) {
        points.push_back(make_point(root, axes, i, registry, findings));
    }
    return points;
}

} // namespace foam::recipe::reading
