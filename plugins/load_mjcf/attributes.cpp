#include "attributes.hpp"

#include <foam/base/text.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace foam::mjcf {
namespace {

/// Words for an orientation. One replaces another.
constexpr std::string_view orientations[] = {"quat", "axisangle", "xyaxes", "zaxis", "euler"};

/// Returns the numbers of `own`, followed by those that `inherited` has beyond them: MuJoCo reads a size into the place
/// of the inherited one.
std::string completed(const std::string& own, const std::string& inherited) {
    std::string text = own;
    const std::vector<std::string_view> before = words(inherited);
    for (std::size_t i = words(own).size(); i < before.size(); ++i) {
        text += " " + std::string(before[i]);
    }
    return text;
}

} // namespace

void Attributes::take(const Node& node) {
    node_ = &node;
    if (std::count_if(std::begin(orientations), std::end(orientations),
                      [&](std::string_view key) { return node.attribute(key) != nullptr; }) > 1) {
        node.fail("it states two orientations; remedy: one of quat, axisangle, euler, xyaxes, zaxis");
    }
    for (const auto& [key, value] : node.element->attributes) {
        if (std::find(std::begin(orientations), std::end(orientations), key) != std::end(orientations)) {
            for (const std::string_view other : orientations) {
                if (const auto old = stated_.find(other); old != stated_.end() && old->second.by != &node) {
                    stated_.erase(old);
                }
            }
        }
        const auto old = stated_.find(key);
        const bool partial = key == "size" && old != stated_.end();
        stated_[key] = {partial ? completed(value, old->second.text) : value, &node};
    }
}

const std::string* Attributes::text(std::string_view key) const {
    const auto found = stated_.find(key);
    return found == stated_.end() ? nullptr : &found->second.text;
}

std::string Attributes::word(std::string_view key, std::string_view otherwise) const {
    const std::string* found = text(key);
    return found ? *found : std::string(otherwise);
}

std::vector<double> Attributes::numbers(std::string_view key, std::size_t least, std::size_t most) const {
    std::vector<double> numbers;
    const std::string* found = text(key);
    if (!found) {
        return numbers;
    }
    for (const std::string_view word : words(*found)) {
        const std::optional<double> number = parse_number(word);
        if (!number) {
            fail(key, fmt::format("'{}' is not a finite number", word));
        }
        numbers.push_back(*number);
    }
    if (numbers.size() < least || numbers.size() > most) {
        fail(key, fmt::format("it expects {}{} number{}, got {}", least,
                              most == least  ? ""
                              : most > 1'000 ? " or more"
                                             : fmt::format(" to {}", most),
                              most == 1 ? "" : "s", numbers.size()));
    }
    return numbers;
}

std::optional<double> Attributes::number(std::string_view key) const {
    const std::vector<double> found = numbers(key, 1, 1);
    return found.empty() ? std::nullopt : std::optional(found.front());
}

std::optional<Vec3> Attributes::vector(std::string_view key) const {
    const std::vector<double> v = numbers(key, 3, 3);
    return v.empty() ? std::nullopt : std::optional(Vec3{v[0], v[1], v[2]});
}

bool Attributes::flag(std::string_view key, bool otherwise, std::optional<bool> automatic) const {
    const std::string* found = text(key);
    if (!found) {
        return otherwise;
    }
    if (automatic && *found == "auto") {
        return *automatic;
    }
    if (*found != "true" && *found != "false") {
        fail(key, fmt::format("'{}' is neither true nor false", *found));
    }
    return *found == "true";
}

void Attributes::fail(std::string_view key, const std::string& what) const {
    const auto found = stated_.find(key);
    const Node& node = found == stated_.end() ? *node_ : *found->second.by;
    node.fail(found == stated_.end() ? fmt::format("<{}>: {}", node.name(), what)
                                     : fmt::format("<{} {}=\"{}\">: {}", node.name(), key, found->second.text, what));
}

Classes::Classes(const Node& root) {
    classes_["main"];
    for (const Node* node : root.children_named("default")) {
        read(*node, nullptr);
    }
}

void Classes::read(const Node& node, const Class* parent) {
    const std::string* name = node.attribute("class");
    if (!parent && name && !name->empty() && *name != "main") {
        node.fail("the outermost class of all defaults is called 'main'; remedy: class=\"main\", or none");
    }
    const std::string& key = parent ? node.required("class") : "main";
    if (parent && classes_.contains(key)) {
        node.fail(fmt::format("a second default class '{}'; remedy: another name", key));
    }
    Class own = parent ? *parent : classes_["main"];
    for (const Node& child : node.children) {
        if (child.name() != "default") {
            own[child.name()].take(child);
        }
    }
    classes_[key] = own;
    for (const Node* child : node.children_named("default")) {
        read(*child, &own);
    }
}

const Classes::Class& Classes::known(const Node& node, const std::string& name) const {
    const auto found = classes_.find(name);
    if (found == classes_.end()) {
        std::vector<std::string> names;
        for (const auto& [known_name, unused] : classes_) {
            names.push_back(known_name);
        }
        const std::string near = nearest_word(name, names);
        node.fail(
            fmt::format("there is no default class '{}'{}", name,
                        near.empty() ? "; remedy: <default class=\"…\">" : fmt::format("; did you mean '{}'?", near)));
    }
    return found->second;
}

Attributes Classes::of(const Node& node, const std::string& childclass) const {
    const std::string* own = node.attribute("class");
    const Class& wanted = known(node, own && !own->empty() ? *own : childclass.empty() ? "main" : childclass);
    const auto found = wanted.find(node.name());
    Attributes attributes = found == wanted.end() ? Attributes() : found->second;
    attributes.take(node);
    return attributes;
}

std::string Classes::childclass_of(const Node& node, const std::string& inherited) const {
    const std::string* own = node.attribute("childclass");
    if (!own || own->empty()) {
        return inherited;
    }
    known(node, *own);
    return *own;
}

} // namespace foam::mjcf
