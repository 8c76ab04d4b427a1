#include "tree_writer.hpp"

#include <foam/base/error.hpp>
#include <foam/base/text.hpp>
#include <foam/sdk/elements.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace foam::tree {
namespace {

using yaml::Value;
using Kind = Value::Kind;

constexpr yaml::TextKind sphere_file{.name = "sphere file", .most_bytes = 64'000'000};

} // namespace

Value parse(const std::string& text, const std::filesystem::path& file) {
    return yaml::tree_of(text, file.string(), sphere_file);
}

void Tree::fail(const Value& at, const std::string& why) const {
    throw Error(ErrorCode::input,
                fmt::format("{}:{}:{}: {}", result.file.string(), at.where.line, at.where.column, shown(why)));
}

const Value& Tree::at(const Value& map, std::string_view key) const {
    const Value* value = map.is(Kind::map) ? map.find(key) : nullptr;
    if (!value) {
        fail(map, fmt::format("expected a map with the key '{}', got {}", key,
                              map.is(Kind::map) ? "one without" : map.description()));
    }
    return *value;
}

const Value& Tree::list(const Value& value, std::string_view what) const {
    if (!value.is(Kind::list)) {
        fail(value, fmt::format("expected {}, got {}", what, value.description()));
    }
    return value;
}

void Tree::require_map(const Value& value) const {
    if (!value.is(Kind::map)) {
        fail(value, fmt::format("expected a map of links, got {}", value.description()));
    }
}

double Tree::number(const Value& value) const {
    const bool whole = value.is(Kind::integer);
    const double number = whole ? static_cast<double>(value.whole) : value.real;
    if ((!whole && !value.is(Kind::number)) || !std::isfinite(number)) {
        fail(value, fmt::format("expected a finite number of metres, got {}", value.description()));
    }
    return number;
}

Vec3 Tree::point(const Value& value) const {
    if (list(value, "a list of three numbers").items.size() != 3) {
        fail(value, fmt::format("expected three numbers, got {}", value.items.size()));
    }
    return {number(value.items[0]), number(value.items[1]), number(value.items[2])};
}

Sphere Tree::sphere(const Value& value) const {
    if (value.is(Kind::list)) {
        if (value.items.size() != 4) {
            fail(value, fmt::format("expected a sphere [x, y, z, radius], got a list of {}", value.items.size()));
        }
        return {{number(value.items[0]), number(value.items[1]), number(value.items[2])}, number(value.items[3])};
    }
    const Value* origin = value.is(Kind::map) ? value.find("origin") : nullptr;
    return {point(origin ? *origin : at(value, "center")), number(at(value, "radius"))};
}

void Tree::add(const std::string& link, const Value& spheres) {
    std::vector<Sphere>& target = spheres_of(result, link);
    if (spheres.is(Kind::null)) {
        return;
    }
    for (const Value& value : list(spheres, fmt::format("a list of spheres for link '{}'", link)).items) {
        target.push_back(sphere(value));
    }
}

void Tree::append_numbers(const Value& value, std::vector<double>& numbers) const {
    if (!value.is(Kind::list)) {
        numbers.push_back(number(value));
        return;
    }
    for (const Value& item : value.items) { // at most as deep as the parser allows
        append_numbers(item, numbers);
    }
}

void Tree::add_elements(const std::string& link, const Value& elements) {
    Elements& all = link_of(result, link).elements;
    for (const Value& object : list(elements, "a list of elements").items) {
        const std::string kind = at(object, "kind").text;
        ElementNumbers numbers;
        for (std::size_t i = 0; i < object.keys.size(); ++i) {
            if (object.keys[i].text != "kind") {
                append_numbers(object.items[i],
                               numbers.emplace_back(object.keys[i].text, std::vector<double>{}).second);
            }
        }
        try {
            all.add(element_of(kind, numbers));
        } catch (const Error& error) {
            fail(object, error.what());
        }
    }
}

void Tree::add_columns(const std::string& link, const Value& value) {
    const Value& centers = list(at(value, "centers"), "a list of centers");
    const Value& radii = list(at(value, "radii"), "a list of radii");
    if (centers.items.size() != radii.items.size()) {
        fail(value, fmt::format("{} centers and {} radii{}", centers.items.size(), radii.items.size(),
                                link.empty() ? "" : fmt::format(" for link '{}'", link)));
    }
    std::vector<Sphere>& target = spheres_of(result, link);
    for (std::size_t i = 0; i < radii.items.size(); ++i) {
        target.push_back({point(centers.items[i]), number(radii.items[i])});
    }
}

double Tree::buffer_of(const Value& buffer, const std::string& link) const {
    const Value* value = buffer.is(Kind::map) ? buffer.find(link) : &buffer;
    return value ? number(*value) : 0;
}

void Tree::read_buffer(const Value& holder, std::string_view key) {
    const Value* buffer = holder.is(Kind::map) ? holder.find(key) : nullptr;
    if (!buffer || buffer->is(Kind::null)) {
        return;
    }
    for (const LinkSpheres& link : result.links) {
        if (const double distance = buffer_of(*buffer, link.link); distance != 0) {
            result.buffers[link.link] = distance;
        }
    }
    if (!result.buffers.empty()) {
        result.notes.push_back(fmt::format("{} (line {}) belongs to the radii: the program that uses the file adds it", key,
                                           buffer->where.line));
    }
}

void Tree::note_self_buffer(const Value& holder, std::string_view key) {
    const Value* buffer = holder.is(Kind::map) ? holder.find(key) : nullptr;
    if (!buffer || buffer->is(Kind::null)) {
        return;
    }
    const bool any = std::any_of(result.links.begin(), result.links.end(),
                                 [&](const LinkSpheres& link) { return buffer_of(*buffer, link.link) != 0; });
    if (any) {
        result.notes.push_back(fmt::format("{} (line {}) changes the radii where the robot is checked against itself: "
                                           "figures, proofs and pairs are without it",
                                           key, buffer->where.line));
    }
}

} // namespace foam::tree
