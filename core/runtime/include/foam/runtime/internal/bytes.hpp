// Values as bytes of this machine, for the cache and for child processes. Not a format for exchange between machines.
#pragma once

#include <foam/geometry/mesh.hpp>
#include <foam/geometry/sphere.hpp>

#include <cstdint>
#include <cstring>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] runtime {

template <class T> void put(std::string& out, const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    out.append(reinterpret_cast<const char*>(&value), sizeof value);
}

inline void put_text(std::string& out, std::string_view text) {
    put(out, static_cast<std::uint64_t>(text.size()));
    out.append(text);
}

template <class T> void put_values(std::string& out, const std::vector<T>& values) {
    static_assert(std::is_trivially_copyable_v<T>);
    put(out, static_cast<std::uint64_t>(values.size()));
    out.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
}

inline void put_mesh(std::string& out, const Mesh& mesh) {
    put_values(out, mesh.vertices);
    put_values(out, mesh.triangles);
}

inline void put_element(std::string& out, const Element& element) {
    put(out, element.kind);
    put(out, element.pose);
    put(out, element.half);
    put(out, element.radius);
    put(out, element.hull != nullptr);
    if (element.hull) {
        put_mesh(out, element.hull->surface);
        put_values(out, element.hull->faces);
    }
}

inline void put_tree(std::string& out, const Approximation& tree) {
    put(out, static_cast<std::uint64_t>(tree.levels.size()));
    for (const Approximation::Level& level : tree.levels) {
        put_values(out, level.elements.spheres());
        put_values(out, level.parents);
        put(out, static_cast<std::uint64_t>(level.elements.shaped().size()));
        for (const Element& element : level.elements.shaped()) {
            put_element(out, element);
        }
    }
}

/// Reads values from the front of a text. After a value that did not fit, all further values are empty and good() is
/// false.
class ByteReader {
public:
    explicit ByteReader(std::string_view bytes) : rest_(bytes) {}

    template <class T> T take() {
        static_assert(std::is_trivially_copyable_v<T>);
        T value{};
        if (fits(sizeof value)) {
            std::memcpy(static_cast<void*>(&value), rest_.data(), sizeof value);
            rest_.remove_prefix(sizeof value);
        }
        return value;
    }
    std::string take_text() {
        const std::uint64_t size = take<std::uint64_t>();
        std::string text;
        if (fits(size)) {
            text = rest_.substr(0, size);
            rest_.remove_prefix(size);
        }
        return text;
    }
    template <class T> std::vector<T> take_values() {
        static_assert(std::is_trivially_copyable_v<T>);
        const std::uint64_t count = take<std::uint64_t>();
        std::vector<T> values;
        if (fits(count) && fits(count * sizeof(T))) { // the first check prevents overflow in the second
            values.resize(count);
            if (count > 0) {
                std::memcpy(static_cast<void*>(values.data()), rest_.data(), count * sizeof(T));
            }
            rest_.remove_prefix(count * sizeof(T));
        }
        return values;
    }
    bool good() const { return good_; }
    bool at_end() const { return rest_.empty(); }

private:
    bool fits(std::uint64_t size) {
        good_ = good_ && size <= rest_.size();
        return good_;
    }
    std::string_view rest_;
    bool good_ = true;
};

inline Mesh take_mesh(ByteReader& in) {
    Mesh mesh;
    mesh.vertices = in.take_values<Vec3>();
    mesh.triangles = in.take_values<Triangle>();
    return mesh;
}

inline Element take_element(ByteReader& in) {
    Element element;
    element.kind = in.take<Element::Kind>();
    element.pose = in.take<Pose>();
    element.half = in.take<Vec3>();
    element.radius = in.take<double>();
    if (in.take<bool>()) {
        auto hull = std::make_shared<Polytope>();
        hull->surface = take_mesh(in);
        hull->faces = in.take_values<Polytope::Face>();
        element.hull = std::move(hull);
    }
    return element;
}

inline Approximation take_tree(ByteReader& in) {
    Approximation tree;
    for (auto levels = in.take<std::uint64_t>(); levels > 0 && in.good(); --levels) {
        Approximation::Level& level = tree.levels.emplace_back();
        level.elements.spheres() = in.take_values<Sphere>();
        level.parents = in.take_values<std::uint32_t>();
        for (auto others = in.take<std::uint64_t>(); others > 0 && in.good(); --others) {
            level.elements.add(take_element(in));
        }
    }
    return tree;
}

} // namespace runtime
} // namespace foam
