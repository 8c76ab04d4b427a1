#include <foam/geometry/elements.hpp>

namespace foam::inline geometry {

Element element_of(const Sphere& sphere) {
    Element element;
    element.pose.translation = sphere.center;
    element.radius = sphere.radius;
    return element;
}

Elements::Elements(std::span<const Element> elements) {
    for (const Element& element : elements) {
        add(element);
    }
}

Elements::Elements(std::vector<Sphere> spheres, const std::vector<Element>& elements) : spheres_(std::move(spheres)) {
    for (const Element& element : elements) {
        add(element);
    }
}

Element Elements::operator[](std::size_t i) const {
    return i < spheres_.size() ? element_of(spheres_[i]) : shaped_[i - spheres_.size()];
}

void Elements::add(Element element) {
    if (element.kind == Element::Kind::sphere) {
        spheres_.push_back({element.pose.translation, element.radius});
    } else {
        shaped_.push_back(std::move(element));
    }
}

void Elements::add(const Elements& more) {
    spheres_.insert(spheres_.end(), more.spheres_.begin(), more.spheres_.end());
    shaped_.insert(shaped_.end(), more.shaped_.begin(), more.shaped_.end());
}

Elements moved(Elements elements, const Pose& pose) {
    for (Sphere& sphere : elements.spheres()) {
        sphere.center = pose * sphere.center;
    }
    for (Element& element : elements.shaped()) {
        element = moved(std::move(element), pose);
    }
    return elements;
}

} // namespace foam::inline geometry
