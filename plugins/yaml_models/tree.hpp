// Links with lists of spheres in a tree of values. The formats differ in the place of these lists and in the form of a
// sphere.
#pragma once

#include <foam/sdk/model.hpp>
#include <foam/yaml/value.hpp>

#include <string>
#include <string_view>

namespace foam::tree {

/// Returns the tree of a YAML or JSON text. Throws Error(input) with the place.
yaml::Value parse(const std::string& text, const std::filesystem::path& file);

/// Fills a SphereFile from values of the tree. All functions throw Error(input) with the place of the value.
class Tree {
public:
    explicit Tree(SphereFile& file) : result(file) {}

    [[noreturn]] void fail(const yaml::Value& at, const std::string& why) const;
    /// Returns the value of a key of a map.
    const yaml::Value& at(const yaml::Value& map, std::string_view key) const;
    /// Returns `value`, which must be a list. `what`: "a list of centers".
    const yaml::Value& list(const yaml::Value& value, std::string_view what) const;
    template <class Body> void for_each(const yaml::Value& map, Body&& body) const {
        require_map(map);
        for (std::size_t i = 0; i < map.keys.size(); ++i) {
            body(map.keys[i].text, map.items[i]);
        }
    }
    /// Adds a list of spheres: `[x, y, z, r]`, `{center, radius}` or `{origin, radius}`.
    void add(const std::string& link, const yaml::Value& spheres);
    /// Adds elements of write.json: `{kind, position, …}`.
    void add_elements(const std::string& link, const yaml::Value& elements);
    /// Adds `{centers: [[x, y, z]], radii: [r]}`.
    void add_columns(const std::string& link, const yaml::Value& value);
    /// Reads a distance that the program which uses the file adds to all radii, or to those of each link. Call it after the
    /// spheres are added.
    void read_buffer(const yaml::Value& holder, std::string_view key);
    /// Adds a note about a distance that the program adds to radii only between links. Call it after the spheres are added.
    void note_self_buffer(const yaml::Value& holder, std::string_view key);

    SphereFile& result;

private:
    void require_map(const yaml::Value& value) const;
    double number(const yaml::Value& value) const;
    double buffer_of(const yaml::Value& buffer, const std::string& link) const;
    void append_numbers(const yaml::Value& value, std::vector<double>& numbers) const;
    Vec3 point(const yaml::Value& value) const;
    Sphere sphere(const yaml::Value& value) const;
};

} // namespace foam::tree
