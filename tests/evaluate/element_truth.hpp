// How far solids stick out of convex elements, in quadruple precision. Shares no code with the proof.
#pragma once

#include <foam/geometry/element.hpp>
#include <foam/geometry/solid.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace foam::test {

__extension__ typedef __float128 Quad; // 113 bits
using Long = long double;              // 64 bits, the same range; to find where something is largest

template <class T> struct Point {
    T x, y, z;

    friend Point operator+(const Point& a, const Point& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
    friend Point operator-(const Point& a, const Point& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
    friend Point operator*(const Point& a, T factor) { return {a.x * factor, a.y * factor, a.z * factor}; }
    friend T dot(const Point& a, const Point& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
    friend Point cross(const Point& a, const Point& b) {
        return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
    }
};
using QuadPoint = Point<Quad>;

inline QuadPoint quad(const Vec3& v) {
    return {v.x, v.y, v.z};
}
template <class T, class From> Point<T> converted(const Point<From>& p) {
    return {static_cast<T>(p.x), static_cast<T>(p.y), static_cast<T>(p.z)};
}
template <class T> T size_of(T x) {
    return x < 0 ? -x : x;
}
/// The square root: that of long double, and a step of Newton's method, which doubles its digits.
template <class T> T root(T x) {
    const T guess = std::sqrt(static_cast<Long>(x));
    return guess > 0 ? (guess + x / guess) / 2 : T(0);
}
template <class T> T norm(const Point<T>& p) {
    return root(dot(p, p));
}

/// An element as it is defined: the image of its shape by p -> R p + t, whatever the numbers in R.
template <class T> class Truth {
public:
    template <class Other>
    explicit Truth(const Truth<Other>& t)
        : kind_(t.kind_), radius_(static_cast<T>(t.radius_)), half_(converted<T>(t.half_)),
          origin_(converted<T>(t.origin_)) {
        std::transform(t.inverse_.begin(), t.inverse_.end(), inverse_.begin(), converted<T, Other>);
        for (const auto& face : t.faces_) {
            faces_.push_back({converted<T>(face.normal), static_cast<T>(face.offset)});
        }
    }
    explicit Truth(const Element& e)
        : kind_(e.kind), radius_(e.radius), half_{e.half.x, e.half.y, e.half.z},
          origin_(converted<T>(quad(e.pose.translation))) {
        const QuadPoint a = quad(e.pose.rotation[0]), b = quad(e.pose.rotation[1]), c = quad(e.pose.rotation[2]);
        const QuadPoint bc = cross(b, c), ca = cross(c, a), ab = cross(a, b); // cofactors
        const Quad share = 1 / dot(a, bc);
        inverse_ = {converted<T>(QuadPoint{bc.x, ca.x, ab.x} * share),
                    converted<T>(QuadPoint{bc.y, ca.y, ab.y} * share),
                    converted<T>(QuadPoint{bc.z, ca.z, ab.z} * share)};
        if (e.hull) {
            find_faces(e.hull->surface.vertices);
        }
    }

    /// A number whose sign says whether the point is outside: at most the distance, and inside the negative distance
    /// from the surface. The ball of radius r about the point lies in the element exactly if it is at most -r.
    T outside(const Point<T>& p) const {
        const Point<T> v = p - origin_, q{dot(inverse_[0], v), dot(inverse_[1], v), dot(inverse_[2], v)};
        if (kind_ == Element::Kind::hull) {
            T most = dot(faces_[0].normal, q) - faces_[0].offset;
            for (const Face& face : faces_) {
                most = std::max(most, dot(face.normal, q) - face.offset);
            }
            return most;
        }
        if (kind_ == Element::Kind::cylinder) {
            return std::max(root(q.x * q.x + q.y * q.y) - radius_, size_of(q.z) - half_.z);
        }
        const Point<T> over{size_of(q.x) - half_.x, size_of(q.y) - half_.y, size_of(q.z) - half_.z};
        const T most = std::max({over.x, over.y, over.z});
        if (kind_ == Element::Kind::box || most <= 0) {
            return most - radius_;
        }
        return norm(Point<T>{std::max(over.x, T(0)), std::max(over.y, T(0)), std::max(over.z, T(0))}) - radius_;
    }

private:
    template <class Other> friend class Truth;
    struct Face {
        Point<T> normal;
        T offset;
    };

    /// The planes through three vertices that have no vertex beyond them. Most triples are refused in less precision.
    void find_faces(const std::vector<Vec3>& corners) {
        std::vector<QuadPoint> vertices(corners.size());
        std::transform(corners.begin(), corners.end(), vertices.begin(), quad);
        std::vector<Point<Long>> rough(corners.size());
        std::transform(vertices.begin(), vertices.end(), rough.begin(), converted<Long, Quad>);
        for (std::size_t i = 0; i < corners.size(); ++i) {
            for (std::size_t j = 0; j < i; ++j) {
                for (std::size_t k = 0; k < j; ++k) {
                    if (!has_both_sides(rough, rough[i], rough[j], rough[k])) {
                        add_face(vertices, vertices[i], vertices[j], vertices[k]);
                    }
                }
            }
        }
    }
    static bool has_both_sides(const std::vector<Point<Long>>& vertices, const Point<Long>& a, const Point<Long>& b,
                               const Point<Long>& c) {
        const Point<Long> n = cross(b - a, c - a);
        const Long rounding = 1e-15L * norm(b - a) * norm(c - a);
        bool below = false, above = false;
        for (const Point<Long>& v : vertices) {
            const Long height = dot(n, v - a), far = rounding * norm(v - a);
            below = below || height < -far;
            above = above || height > far;
            if (below && above) {
                return true;
            }
        }
        return false;
    }
    void add_face(const std::vector<QuadPoint>& vertices, const QuadPoint& a, const QuadPoint& b, const QuadPoint& c) {
        QuadPoint n = cross(b - a, c - a);
        const Quad length = norm(n);
        if (!(length > 0)) {
            return;
        }
        n = n * (1 / length);
        Quad low = 0, high = 0;
        for (const QuadPoint& v : vertices) {
            const Quad height = dot(n, v - a);
            low = std::min(low, height);
            high = std::max(high, height);
        }
        const Quad hair = 1e-28 * (high - low); // the rounding of quadruple precision
        if (high <= hair || low >= -hair) {
            n = high <= hair ? n : n * Quad(-1);
            faces_.push_back({converted<T>(n), static_cast<T>(dot(n, a))});
        }
    }

    Element::Kind kind_;
    T radius_;
    Point<T> half_;
    Point<T> origin_;
    std::array<Point<T>, 3> inverse_;
    std::vector<Face> faces_;
};

/// A circle: center + x cos + y sin.
template <class T> struct Ring {
    Point<T> center, x, y;

    /// The point at `turn`, in about quarter turns, by the rational parametrisation.
    Point<T> at(T turn) const {
        const Long whole = std::floor(static_cast<Long>(turn));
        const T t = turn - whole, c = (1 - t * t) / (1 + t * t), s = 2 * t / (1 + t * t);
        switch (static_cast<int>(whole) & 3) {
        case 0:
            return center + x * c + y * s;
        case 1:
            return center + y * c - x * s;
        case 2:
            return center - x * c - y * s;
        default:
            return center - y * c + x * s;
        }
    }
};

/// What a convex solid is the hull of: balls of one radius about points, and circles.
struct Extremes {
    std::vector<QuadPoint> points;
    Quad ball = 0;
    std::vector<Ring<Quad>> rings;
};

inline QuadPoint turned(const Pose& pose, const QuadPoint& p) {
    return {dot(quad(pose.rotation[0]), p), dot(quad(pose.rotation[1]), p), dot(quad(pose.rotation[2]), p)};
}

inline Extremes extremes(const Solid::Part& part) {
    Extremes result;
    if (part.mesh) {
        std::transform(part.mesh->vertices.begin(), part.mesh->vertices.end(), std::back_inserter(result.points), quad);
        return result;
    }
    const Element& p = *part.primitive;
    const QuadPoint middle = quad(part.pose.translation);
    const auto add = [&](Quad x, Quad y, Quad z) { result.points.push_back(middle + turned(part.pose, {x, y, z})); };
    const Quad half = Quad(p.half.z);
    switch (p.kind) {
    case Element::Kind::box:
        for (int k = 0; k < 8; ++k) {
            const Quad x = p.half.x, y = p.half.y, z = p.half.z;
            add(k & 1 ? x : -x, k & 2 ? y : -y, k & 4 ? z : -z);
        }
        break;
    case Element::Kind::sphere:
        add(0, 0, 0);
        result.ball = p.radius;
        break;
    case Element::Kind::capsule:
        add(0, 0, half);
        add(0, 0, -half);
        result.ball = p.radius;
        break;
    case Element::Kind::cylinder:
        for (const Quad end : {half, -half}) {
            result.rings.push_back({middle + turned(part.pose, {0, 0, end}), turned(part.pose, {p.radius, 0, 0}),
                                    turned(part.pose, {0, p.radius, 0})});
        }
        break;
    case Element::Kind::swept_box:
    case Element::Kind::hull:
    case Element::Kind::ellipsoid:
        throw std::logic_error("no such part is tested here");
    }
    return result;
}

/// Both precisions of one element.
class Judge {
public:
    explicit Judge(const Element& e) : exact_(e), quick_(exact_) {}

    Quad outside(const QuadPoint& p) const { return exact_.outside(p); }

    /// How far the solid sticks out: above 0 exactly if it does. A circle's is that of one of its points, so it is
    /// never too large; all largest places of a dense sample are looked at closely.
    Quad outside(const Extremes& solid) const {
        Quad most = -1e300;
        most *= 1e300; // less than anything here
        for (const QuadPoint& p : solid.points) {
            most = std::max(most, outside(p) + solid.ball);
        }
        for (const Ring<Quad>& ring : solid.rings) {
            most = std::max(most, outside(ring));
        }
        return most;
    }
    Quad outside(const Solid::Part& part) const { return outside(extremes(part)); }

private:
    Quad outside(const Ring<Quad>& ring) const {
        constexpr int samples = 96;
        const Ring<Long> rough{converted<Long>(ring.center), converted<Long>(ring.x), converted<Long>(ring.y)};
        const auto value = [&](Long turn) { return quick_.outside(rough.at(turn)); };
        const auto turn_of = [](int k) { return 4 * static_cast<Long>(k) / samples; };
        std::array<Long, samples> sample;
        for (int k = 0; k < samples; ++k) {
            sample[static_cast<std::size_t>(k)] = value(turn_of(k));
        }
        Quad most = outside(ring.at(0));
        int looks = 8;
        for (std::size_t k = 0; k < samples && looks > 0; ++k) {
            if (sample[k] >= sample[(k + 1) % samples] && sample[k] >= sample[(k + samples - 1) % samples]) {
                const int place = static_cast<int>(k);
                most = std::max(most, outside(ring.at(largest(value, turn_of(place - 1), turn_of(place + 1)))));
                --looks;
            }
        }
        return most;
    }
    /// Where the value is largest between two places, by the golden section.
    template <class Value> static Long largest(const Value& value, Long low, Long high) {
        const Long part = (std::sqrt(Long(5)) - 1) / 2;
        Long a = high - part * (high - low), b = low + part * (high - low), at_a = value(a), at_b = value(b);
        for (int step = 0; step < 45; ++step) {
            if (at_a > at_b) {
                high = b;
                b = a;
                at_b = at_a;
                at_a = value(a = high - part * (high - low));
            } else {
                low = a;
                a = b;
                at_a = at_b;
                at_b = value(b = low + part * (high - low));
            }
        }
        return (low + high) / 2;
    }

    Truth<Quad> exact_;
    Truth<Long> quick_;
};

} // namespace foam::test
