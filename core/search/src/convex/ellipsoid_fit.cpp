#include "ellipsoid_fit.hpp"

#include "fit_programme.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace foam::inline search::convex {
namespace {

/// The weights of points, and what follows from them. With p lifted to q = (p, 1): X = Σ uᵢ qᵢ qᵢᵀ, and qᵀ X⁻¹ q is 4
/// on the ellipsoid of the weights.
class Weights {
public:
    explicit Weights(const std::vector<Vec3>& points) : points_(points), weights_(points.size()), reach_(points.size()) {
        std::fill(weights_.begin(), weights_.end(), 1 / static_cast<double>(points.size()));
        invert();
    }

    /// Moves weight to the point that is farthest outside, or away from the one deepest inside. Returns false if
    /// neither is off by the accuracy.
    bool step(double accuracy) {
        std::size_t far = 0, deep = points_.size();
        for (std::size_t i = 0; i < points_.size(); ++i) {
            far = reach_[i] > reach_[far] ? i : far;
            if (weights_[i] > 0 && (deep == points_.size() || reach_[i] < reach_[deep])) {
                deep = i;
            }
        }
        if (deep == points_.size()) {
            return false;
        }
        const double outside = reach_[far] / 4 - 1, inside = 1 - reach_[deep] / 4;
        const bool away = inside > outside;
        if (!(std::max(outside, inside) > accuracy) || (away && !(weights_[deep] < 1))) { // or rounding
            return false;
        }
        const std::size_t i = away ? deep : far;
        double share = (reach_[i] - 4) / (4 * (reach_[i] - 1));
        if (away) {
            const double all = -weights_[i] / (1 - weights_[i]);
            share = reach_[i] > 1 ? std::max(share, all) : all;
        }
        move(i, share);
        return true;
    }

    /// Returns the ellipsoid of the weights, with half axes of at least `thin`.
    Fit ellipsoid() const {
        Eigen::Vector3d middle = Eigen::Vector3d::Zero();
        Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
        for (std::size_t i = 0; i < points_.size(); ++i) {
            const Eigen::Vector3d p(points_[i].x, points_[i].y, points_[i].z);
            middle += weights_[i] * p;
            spread += weights_[i] * p * p.transpose();
        }
        const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(spread - middle * middle.transpose());
        Fit fit{.kind = Element::Kind::ellipsoid};
        fit.center = {middle.x(), middle.y(), middle.z()};
        for (int k = 0; k < 3; ++k) {
            const Eigen::Vector3d axis = axes.eigenvectors().col(k);
            fit.axes[static_cast<std::size_t>(k)] = {axis.x(), axis.y(), axis.z()};
            fit.half[k] = std::max(std::sqrt(std::max(3 * axes.eigenvalues()(k), 0.0)), thin);
        }
        fit.axes[0] = normalized(fit.axes[0]);
        fit.axes[1] = normalized(fit.axes[1] - fit.axes[0] * dot(fit.axes[0], fit.axes[1]));
        fit.axes[2] = cross(fit.axes[0], fit.axes[1]);
        return fit;
    }

private:
    Eigen::Vector4d lifted(std::size_t i) const { return {points_[i].x, points_[i].y, points_[i].z, 1}; }

    void invert() {
        Eigen::Matrix4d sum = Eigen::Matrix4d::Zero();
        for (std::size_t i = 0; i < points_.size(); ++i) {
            sum += weights_[i] * lifted(i) * lifted(i).transpose();
        }
        sum.diagonal().head<3>().array() += thin * thin; // of flat points it has no inverse
        inverse_ = sum.inverse();
        for (std::size_t i = 0; i < points_.size(); ++i) {
            reach_[i] = lifted(i).dot(inverse_ * lifted(i));
        }
    }

    /// Multiplies all weights by 1 - share and adds the share to one (Sherman and Morrison 1950).
    void move(std::size_t i, double share) {
        const Eigen::Vector4d along = inverse_ * lifted(i);
        const double factor = share / (1 - share + share * reach_[i]);
        for (std::size_t k = 0; k < points_.size(); ++k) {
            const double with = along.dot(lifted(k));
            reach_[k] = (reach_[k] - factor * with * with) / (1 - share);
            weights_[k] *= 1 - share;
        }
        inverse_ = (inverse_ - factor * along * along.transpose()) / (1 - share);
        weights_[i] = std::max(weights_[i] + share, 0.0);
    }

    const std::vector<Vec3>& points_;
    std::vector<double> weights_, reach_;
    Eigen::Matrix4d inverse_;
};

} // namespace

double reach_of_ellipsoid(const Fit& fit, const Vec3& local) {
    return norm(Vec3{local.x / fit.half.x, local.y / fit.half.y, local.z / fit.half.z});
}

Vec3 normal_of_ellipsoid(const Fit& fit, const Vec3& local, double& slope) {
    const Vec3& a = fit.half;
    const Vec3 gradient{local.x / (a.x * a.x), local.y / (a.y * a.y), local.z / (a.z * a.z)};
    const double length = norm(gradient), reach = reach_of_ellipsoid(fit, local);
    slope = reach > 0 ? length / reach : 0;
    return length > 0 ? gradient / length : Vec3{};
}

double area_of_ellipsoid(const Fit& fit) {
    constexpr double power = 1.6075;
    const auto product = [](double a, double b) { return std::pow(a * b, power); };
    const Vec3& a = fit.half;
    return 4 * std::numbers::pi * std::pow((product(a.x, a.y) + product(a.x, a.z) + product(a.y, a.z)) / 3, 1 / power);
}

Fit least_ellipsoid(const Cloud& cloud, double accuracy, int most_steps) {
    Weights weights(cloud.points);
    for (int step = 0; step < most_steps && weights.step(accuracy); ++step) {
    }
    Fit fit = weights.ellipsoid();
    close_around(fit, cloud);
    return fit;
}

} // namespace foam::inline search::convex
