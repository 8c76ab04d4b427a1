#include "measure/farthest_exposed.hpp"

#include "proof/surface_pieces.hpp"

#include <foam/base/cancellation.hpp>

#include <algorithm>
#include <queue>

namespace foam::inline geometry {
namespace {

/// A piece of the surface, with a bound of the distance of its points.
struct Bounded {
    double most;
    SurfacePiece piece;

    bool operator<(const Bounded& other) const { return most < other.most; }
};

class Farthest {
public:
    Farthest(const Solid& solid, const Element& element, std::span<const Element> near, double known,
             const std::function<bool(const Vec3&, const Vec3&)>& exposed)
        : solid_(solid), element_(element), surface_(element, {}), near_(near), found_(known), exposed_(exposed) {}

    double run() {
        constexpr double accuracy = 1.01;
        constexpr int most_pieces = 4'000;
        for (const SurfacePiece& piece : surface_.pieces()) {
            look_at(piece);
        }
        for (int k = 0; k < most_pieces && !waiting_.empty(); ++k) {
            asking_.check();
            const Bounded next = waiting_.top();
            waiting_.pop();
            if (next.most <= accuracy * found_) {
                break;
            }
            const auto [first, second] = surface_.halves(next.piece);
            look_at(first);
            look_at(second);
        }
        return found_;
    }

private:
    /// The distance from the solid changes no faster than the point.
    void look_at(const SurfacePiece& piece) {
        surface_.points(piece, points_);
        Vec3 middle{};
        for (const Vec3& p : points_) {
            middle += p / static_cast<double>(points_.size());
        }
        double radius = 0;
        for (const Vec3& p : points_) {
            radius = std::max(radius, distance(p, middle));
        }
        const double most = solid_.signed_distance(middle) + radius;
        if (most <= found_ || is_held()) {
            return;
        }
        surface_.normals(piece, normals_);
        for (std::size_t k = 0; k < piece.count; ++k) {
            const Vec3& p = points_[k]; // the first points are on the surface
            const Vec3 normal = k < normals_.size() ? normals_[k] : surface_.normal_of_flat(piece);
            const bool on_it = signed_distance(element_, p) <= 1e-9 * most; // the ends of a cylinder lie within squares
            if (const double there = on_it ? solid_.signed_distance(p) : 0; there > found_ && exposed_(p, normal)) {
                found_ = there;
            }
        }
        waiting_.push({most, piece});
    }
    bool is_held() const {
        return std::any_of(near_.begin(), near_.end(), [&](const Element& e) {
            return std::all_of(points_.begin(), points_.end(), [&](const Vec3& p) { return holds(e, p); });
        });
    }

    const Solid& solid_;
    const Element& element_;
    ElementSurface surface_;
    std::span<const Element> near_;
    double found_;
    const std::function<bool(const Vec3&, const Vec3&)>& exposed_;
    std::priority_queue<Bounded> waiting_;
    std::vector<Vec3> points_, normals_;
    CancellationCounter asking_{64};
};

} // namespace

double farthest_exposed(const Solid& solid, const Element& element, std::span<const Element> near, double known,
                        const std::function<bool(const Vec3&, const Vec3&)>& exposed) {
    return Farthest(solid, element, near, known, exposed).run();
}

} // namespace foam::inline geometry
