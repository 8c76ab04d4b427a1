#include <foam/recipe/internal/yaml.hpp>

#include <fmt/format.h>

#include <charconv>

namespace foam::inline recipe::reading {
namespace {

bool starts_with_key(std::string_view path, std::string_view key) {
    return path.starts_with(key) && (path.size() == key.size() || path[key.size()] == '.');
}

std::string_view rest_after(std::string_view path, std::string_view key) {
    path.remove_prefix(key.size());
    return path.empty() ? path : path.substr(1);
}

class Editor {
public:
    Editor(std::string_view path, const Value& value, const Registry& registry)
        : path_(path), value_(value), registry_(registry) {}

    std::string set(Value& node, std::string_view rest) const {
        if (rest.empty()) {
            node = value_;
            return "";
        }
        if (node.is(Value::Kind::list)) {
            return set_item(node, rest);
        }
        make_map(node, rest);
        return node.is(Value::Kind::map)
                   ? set_key(node, rest)
                   : fmt::format("{} has no keys, it is {}", in_quotes(before(rest)), node.description());
    }

private:
    /// Returns the part of the path before `rest`.
    std::string_view before(std::string_view rest) const {
        const std::size_t length = path_.size() - rest.size();
        return path_.substr(0, length == 0 ? 0 : length - 1);
    }

    /// Replaces short forms by a map: nothing, `snapshots: true`, `- stage`.
    void make_map(Value& node, std::string_view rest) const {
        const bool short_stage = node.is(Value::Kind::text) && starts_with_key(rest, node.text);
        if (node.is(Value::Kind::null) || short_stage ||
            (node.is(Value::Kind::boolean) && before(rest) == "snapshots")) {
            Value map;
            map.kind = Value::Kind::map;
            map.where = value_.where;
            if (short_stage) {
                map.keys.push_back({node.text, node.where});
                map.items.emplace_back();
                map.items.back().where = node.where;
            }
            node = std::move(map);
        }
    }

    std::string set_key(Value& map, std::string_view rest) const {
        const std::string key = key_of(map, rest);
        const std::string_view after = rest_after(rest, key);
        const bool known = map.find_key(key) != nullptr;
        if (after.empty() && value_.is(Value::Kind::null)) {
            map.erase(key);
            return "";
        }
        if (!known) {
            map.keys.push_back({key, value_.where});
            map.items.emplace_back();
            map.items.back().where = value_.where;
        }
        for (std::size_t i = 0; i < map.keys.size(); ++i) {
            if (map.keys[i].text == key) {
                return set(map.items[i], after);
            }
        }
        return "";
    }

    std::string key_of(const Value& map, std::string_view rest) const {
        std::string best;
        for (const Key& key : map.keys) {
            if (key.text.size() > best.size() && starts_with_key(rest, key.text)) {
                best = key.text;
            }
        }
        if (!best.empty()) {
            return best;
        }
        if (const std::string_view here = before(rest); here == "sweep" || here == "snapshots.pose") {
            return std::string(rest);
        }
        for (const auto& [stage, unused] : registry_.stages()) {
            if (stage.size() > best.size() && starts_with_key(rest, stage)) {
                best = stage;
            }
        }
        return best.empty() ? std::string(rest.substr(0, rest.find('.'))) : best;
    }

    std::string set_item(Value& list, std::string_view rest) const {
        std::size_t index = 0;
        const char* begin = rest.data();
        const auto [end, error] = std::from_chars(begin, begin + rest.size(), index);
        const std::string_view number = rest.substr(0, static_cast<std::size_t>(end - begin));
        if (error == std::errc() && starts_with_key(rest, number)) {
            if (index >= list.items.size()) {
                return fmt::format("{} has {} items, counted from 0", in_quotes(before(rest)), list.items.size());
            }
            const std::string_view after = rest_after(rest, number);
            if (after.empty() && value_.is(Value::Kind::null)) {
                list.items.erase(list.items.begin() + static_cast<std::ptrdiff_t>(index));
                return "";
            }
            return set(list.items[index], after);
        }
        return set_named_item(list, rest);
    }

    std::string set_named_item(Value& list, std::string_view rest) const {
        Value* found = nullptr;
        std::vector<std::string> names;
        for (Value& item : list.items) {
            const bool named = item.is(Value::Kind::map) && item.keys.size() == 1;
            const std::string& name = named ? item.keys[0].text : item.text;
            if (!named && !item.is(Value::Kind::text)) {
                continue;
            }
            names.push_back(name);
            if (starts_with_key(rest, name)) {
                if (found) {
                    return fmt::format("{} is in {} more than once; remedy: give its number, counted from 0",
                                       in_quotes(name), in_quotes(before(rest)));
                }
                found = &item;
            }
        }
        if (!found) {
            return fmt::format("{} has no item {}{}", in_quotes(before(rest)), in_quotes(rest),
                               suggestion(rest, names));
        }
        return set(*found, rest);
    }

    std::string_view path_;
    const Value& value_;
    const Registry& registry_;
};

} // namespace

std::string set_by_path(Value& root, std::string_view path, const Value& value, const Registry& registry) {
    if (path.empty() || path.front() == '.' || path.back() == '.' || path.find("..") != std::string_view::npos) {
        return "the path is not of the form key.key";
    }
    return Editor(path, value, registry).set(root, path);
}

} // namespace foam::recipe::reading
