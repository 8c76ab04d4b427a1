#include <foam/geometry/cell.hpp>

#include <Eigen/Eigenvalues>

namespace foam::inline geometry {

std::array<Vec3, 3> principal_axes(const Solid& solid) {
    // Exact moments of the triangles: ∫ p pᵀ dA = A/12 (Σ cᵢ cᵢᵀ + (Σ cᵢ)(Σ cᵢ)ᵀ) over their corners.
    const Mesh& mesh = solid.surface();
    const Vec3 middle = solid.bounds().center();
    const double unit = solid.bounds().diagonal() > 0 ? 1 / solid.bounds().diagonal() : 1;
    double total = 0;
    Eigen::Vector3d first = Eigen::Vector3d::Zero();
    Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
    for (const Triangle& triangle : mesh.triangles) {
        Eigen::Matrix3d corners;
        for (int k = 0; k < 3; ++k) {
            const Vec3 p = (mesh.vertices[triangle[k]] - middle) * unit;
            corners.col(k) << p.x, p.y, p.z;
        }
        const Eigen::Vector3d ab = corners.col(1) - corners.col(0), ac = corners.col(2) - corners.col(0);
        const double area = ab.cross(ac).norm() / 2;
        const Eigen::Vector3d sum = corners.rowwise().sum();
        total += area;
        first += area / 3 * sum;
        second += area / 12 * (corners * corners.transpose() + sum * sum.transpose());
    }
    if (!(total > 0)) {
        return {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
    }
    const Eigen::Matrix3d covariance = second / total - first * first.transpose() / (total * total);
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance); // ascending
    const auto column = [&](int i) {
        const Eigen::Vector3d v = solver.eigenvectors().col(i);
        return normalized(Vec3{v.x(), v.y(), v.z()});
    };
    const Vec3 longest = column(2), middle_axis = column(1);
    return {longest, middle_axis, cross(longest, middle_axis)};
}

} // namespace foam::geometry
