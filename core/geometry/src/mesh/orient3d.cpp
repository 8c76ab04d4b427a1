#include "mesh/orient3d.hpp"

#include <cstddef>

namespace foam::inline geometry {
namespace {

/// A number as the sum of doubles that do not overlap, ascending by magnitude, without zeros.
template <std::size_t Most> struct Expansion {
    std::array<double, Most> part;
    std::size_t count = 0;

    void push(double x) {
        if (x != 0) {
            part[count++] = x;
        }
    }
    int sign() const { return count == 0 ? 0 : part[count - 1] > 0 ? 1 : -1; }
};

struct TwoParts {
    double sum, rest;
};

/// Returns a + b without error (Knuth).
TwoParts two_sum(double a, double b) {
    const double sum = a + b, of_b = sum - a, of_a = sum - of_b;
    return {sum, (a - of_a) + (b - of_b)};
}

TwoParts two_product(double a, double b) {
    const double product = a * b;
    return {product, std::fma(a, b, -product)};
}

/// Returns a + b: each part of b joins the expansion (Shewchuk's Grow-Expansion).
template <std::size_t A, std::size_t B> Expansion<A + B> sum(const Expansion<A>& a, const Expansion<B>& b) {
    Expansion<A + B> result;
    for (std::size_t i = 0; i < a.count; ++i) {
        result.part[result.count++] = a.part[i];
    }
    for (std::size_t i = 0; i < b.count; ++i) {
        double carried = b.part[i];
        std::size_t kept = 0;
        for (std::size_t k = 0; k < result.count; ++k) {
            const TwoParts s = two_sum(carried, result.part[k]);
            carried = s.sum;
            if (s.rest != 0) {
                result.part[kept++] = s.rest;
            }
        }
        result.count = kept;
        result.push(carried);
    }
    return result;
}

template <std::size_t A> Expansion<2 * A> scaled(const Expansion<A>& a, double factor) {
    Expansion<2 * A> result;
    double carried = 0;
    for (std::size_t i = 0; i < a.count; ++i) {
        const TwoParts product = two_product(a.part[i], factor);
        const TwoParts low = two_sum(carried, product.rest);
        result.push(low.rest);
        const TwoParts high = two_sum(product.sum, low.sum);
        result.push(high.rest);
        carried = high.sum;
    }
    result.push(carried);
    return result;
}

template <std::size_t A> Expansion<4 * A> product(const Expansion<A>& a, const Expansion<2>& b) {
    Expansion<2 * A> low, high;
    low = b.count > 0 ? scaled(a, b.part[0]) : low;
    high = b.count > 1 ? scaled(a, b.part[1]) : high;
    return sum(low, high);
}

template <std::size_t A> Expansion<A> negated(Expansion<A> a) {
    for (std::size_t i = 0; i < a.count; ++i) {
        a.part[i] = -a.part[i];
    }
    return a;
}

Expansion<2> difference(double a, double b) {
    const TwoParts s = two_sum(a, -b);
    Expansion<2> result;
    result.push(s.rest);
    result.push(s.sum);
    return result;
}

struct ExactVec {
    ExactVec(const Vec3& p, const Vec3& from)
        : x(difference(p.x, from.x)), y(difference(p.y, from.y)), z(difference(p.z, from.z)) {}
    Expansion<2> x, y, z;
};

/// Returns a b - c d.
Expansion<16> minor(const Expansion<2>& a, const Expansion<2>& b, const Expansion<2>& c, const Expansion<2>& d) {
    return sum(product(a, b), negated(product(c, d)));
}

int exact_sign(const ExactVec& b, const ExactVec& c, const ExactVec& p) {
    const auto by_x = product(minor(b.y, c.z, b.z, c.y), p.x);
    const auto by_y = product(minor(b.z, c.x, b.x, c.z), p.y);
    const auto by_z = product(minor(b.x, c.y, b.y, c.x), p.z);
    return sum(sum(by_x, by_y), by_z).sign();
}

} // namespace

int orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& p) {
    const Vec3 u = b - a, v = c - a, w = p - a;
    const Vec3 first{u.y * v.z, u.z * v.x, u.x * v.y}, second{u.z * v.y, u.x * v.z, u.y * v.x};
    const double value = dot(first - second, w);
    const double size = (std::abs(first.x) + std::abs(second.x)) * std::abs(w.x) +
                        (std::abs(first.y) + std::abs(second.y)) * std::abs(w.y) +
                        (std::abs(first.z) + std::abs(second.z)) * std::abs(w.z);
    constexpr double error = 16 * 0x1p-53; // Shewchuk's bound is (7 + 56 u) u
    if (value > error * size || -value > error * size) {
        return value > 0 ? 1 : -1;
    }
    return exact_sign({b, a}, {c, a}, {p, a});
}

} // namespace foam::geometry
