// Convex elements of any kind in one container.
#pragma once

#include <foam/geometry/element.hpp>

#include <cstddef>
#include <initializer_list>
#include <iterator>
#include <span>
#include <utility>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] geometry {

/// A ball: all points within `radius` of `center`. Metres; link frame.
struct Sphere {
    Vec3 center;
    double radius = 0;

    bool operator==(const Sphere&) const = default;
};

/// Returns the element that is this ball.
Element element_of(const Sphere& sphere);

/// Convex elements, in one order: spheres first, then elements of other kinds. Within both, the order in which they were added.
/// Most models are spheres alone, and millions of them are searched, so that they are held apart: 32 bytes each.
class Elements {
public:
    Elements() = default;
    Elements(std::initializer_list<Sphere> spheres) : spheres_(spheres) {}
    Elements(std::vector<Sphere> spheres) : spheres_(std::move(spheres)) {}
    Elements(std::span<const Sphere> spheres) : spheres_(spheres.begin(), spheres.end()) {}
    Elements(const std::vector<Element>& elements) : Elements(std::span(elements)) {}
    Elements(std::span<const Element> elements);
    Elements(std::vector<Sphere> spheres, const std::vector<Element>& elements);

    std::size_t size() const { return spheres_.size() + shaped_.size(); }
    bool empty() const { return spheres_.empty() && shaped_.empty(); }
    /// Returns the element at an index; a sphere as an element of its kind. O(1); copies it.
    Element operator[](std::size_t i) const;
    /// Returns whether all are spheres; then spheres() is all there is.
    bool are_spheres() const { return shaped_.empty(); }
    /// Returns the spheres: the elements [0, spheres().size()).
    const std::vector<Sphere>& spheres() const& { return spheres_; }
    std::vector<Sphere>& spheres() & { return spheres_; }
    std::vector<Sphere> spheres() && { return std::move(spheres_); }
    /// Returns the elements that are no spheres: those from spheres().size() on.
    std::span<const Element> shaped() const& { return shaped_; }
    std::span<Element> shaped() & { return shaped_; }
    std::vector<Element> shaped() && { return std::move(shaped_); }

    void add(const Sphere& sphere) { spheres_.push_back(sphere); }
    void add(Element element);
    void add(const Elements& more);

    /// Walks over all elements in order; each is a copy.
    class Iterator {
    public:
        using iterator_category = std::input_iterator_tag;
        using value_type = Element;
        using difference_type = std::ptrdiff_t;
        using pointer = const Element*;
        using reference = Element;

        Iterator() = default;
        Iterator(const Elements& elements, std::size_t at) : elements_(&elements), at_(at) {}
        Element operator*() const { return (*elements_)[at_]; }
        Iterator& operator++() {
            ++at_;
            return *this;
        }
        Iterator operator++(int) {
            Iterator before = *this;
            ++at_;
            return before;
        }
        bool operator==(const Iterator& other) const { return at_ == other.at_; }

    private:
        const Elements* elements_ = nullptr;
        std::size_t at_ = 0;
    };
    Iterator begin() const { return {*this, 0}; }
    Iterator end() const { return {*this, size()}; }

    bool operator==(const Elements&) const = default;

private:
    std::vector<Sphere> spheres_;
    std::vector<Element> shaped_; ///< none is a sphere
};

/// Returns the elements at another pose: `pose` maps their frame to the new one.
Elements moved(Elements elements, const Pose& pose);

} // namespace geometry
} // namespace foam
