#include "by_spheres/starts/starts.hpp"

#include "by_spheres/measured/points.hpp"
#include "by_spheres/portfolio/problem.hpp"

#include <foam/base/cancellation.hpp>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <ranges>

namespace foam::inline search::by_spheres {
namespace {

float squared_distance(const Points& p, std::size_t i, std::size_t j) {
    const float dx = p.x[i] - p.x[j], dy = p.y[i] - p.y[j], dz = p.z[i] - p.z[j];
    return dx * dx + dy * dy + dz * dz;
}

/// Returns seeds drawn with a probability that grows with the squared distance from those before.
std::vector<std::size_t> far_seeds(const Points& points, std::size_t count, Random& random) {
    std::vector<std::size_t> seeds{random.below(points.size())};
    std::vector<float> nearest(points.size(), std::numeric_limits<float>::infinity());
    while (seeds.size() < count) {
        check_cancelled();
        double sum = 0;
        for (std::size_t p = 0; p < points.size(); ++p) {
            nearest[p] = std::min(nearest[p], squared_distance(points, p, seeds.back()));
            sum += nearest[p];
        }
        double rest = random.uniform() * sum;
        std::size_t p = 0;
        while (p + 1 < points.size() && (rest -= nearest[p]) > 0) {
            ++p;
        }
        seeds.push_back(p);
    }
    return seeds;
}

/// Moves centres to the centroids of their nearest points. Radii are root mean square distances, which weight sizes
/// correctly.
void lloyd(const Points& points, Balls& balls, int rounds) {
    Deepest owners;
    for (int round = 0; round < rounds; ++round) {
        check_cancelled();
        for (Ball& ball : balls) {
            ball.r = 0;
        }
        find_owners(points, balls, owners);
        std::vector<std::array<double, 4>> sum(balls.size());
        for (std::size_t p = 0; p < points.size(); ++p) {
            auto& s = sum[owners.ball[p]];
            s = {s[0] + points.x[p], s[1] + points.y[p], s[2] + points.z[p], s[3] + 1};
        }
        for (std::size_t i = 0; i < balls.size(); ++i) {
            const auto& s = sum[i];
            if (s[3] > 0) {
                balls[i] = {static_cast<float>(s[0] / s[3]), static_cast<float>(s[1] / s[3]),
                            static_cast<float>(s[2] / s[3]), 0};
            }
        }
    }
    tighten(points, balls);
}

FOAM_FOR_WIDE_VECTORS
void mark_within(const Points& points, const Ball& ball, const float* gaps, char* marks) {
    constexpr float wider = 1 + 1e-5f; // more than rounding
    for (std::size_t p = 0; p < points.size(); ++p) {
        const float reach = std::max(0.0f, (ball.r + gaps[p]) * wider);
        marks[p] = ball.squared_distance(points.x[p], points.y[p], points.z[p]) <= reach * reach ? 1 : 0;
    }
}

/// Returns the points that lie less than their gap outside the ball.
Points points_within(const Points& points, const Ball& ball, const std::vector<float>& gaps) {
    std::vector<char> marks(points.size());
    mark_within(points, ball, gaps.data(), marks.data());
    Points within;
    for (std::size_t p = 0; p < points.size(); ++p) {
        if (marks[p]) {
            within.add(points, p);
        }
    }
    return within;
}

float outside(const Ball& ball, const Points& points, std::size_t p) {
    return std::sqrt(ball.squared_distance(points.x[p], points.y[p], points.z[p])) - ball.r;
}

/// Returns the other balls that come to within `gap` of ball `i`, the nearest first.
std::vector<std::uint32_t> others_near(std::size_t i, const Balls& balls, float gap) {
    std::vector<std::pair<float, std::uint32_t>> others;
    for (std::uint32_t k = 0; k < balls.size(); ++k) {
        const float reach = balls[i].r + balls[k].r + gap, squared = squared_distance(balls[i], balls[k]);
        if (k != i && squared <= reach * reach) {
            others.emplace_back(squared, k);
        }
    }
    std::ranges::sort(others);
    std::vector<std::uint32_t> result;
    std::ranges::copy(std::views::values(others), std::back_inserter(result));
    return result;
}

/// Returns those of the points that lie deepest in ball `i`; of equal balls the first counts. The balls nearest to it
/// are compared first: most points lie deeper in one of them.
Points deepest_in(const Balls& balls, std::size_t i, const Points& points) {
    float farthest = 0;
    for (std::size_t p = 0; p < points.size(); ++p) {
        farthest = std::max(farthest, outside(balls[i], points, p));
    }
    constexpr float wider = 1 + 1e-5f; // more than rounding
    const std::vector<std::uint32_t> others = others_near(i, balls, 2 * farthest * wider);
    Points owned;
    for (std::size_t p = 0; p < points.size(); ++p) {
        const float own = outside(balls[i], points, p);
        if (std::ranges::none_of(others, [&](std::uint32_t k) {
                const float other = outside(balls[k], points, p);
                return other < own || (other == own && k < i);
            })) {
            owned.add(points, p);
        }
    }
    return owned;
}

Vec3 along(const Vec3& p, const std::array<Vec3, 3>& axes) {
    return {dot(p, axes[0]), dot(p, axes[1]), dot(p, axes[2])};
}

} // namespace

Points body_points(const Problem& problem, std::size_t count) {
    Points points;
    const auto add = [&](const Points& from, std::size_t most) {
        for (std::size_t i = 0; i < std::min(most, from.size()); ++i) {
            points.add(from, i * from.size() / std::min(most, from.size()));
        }
    };
    add(problem.surface, count / 2);
    add(problem.occupancy.inside(), count / 2);
    return points;
}

Balls clusters(const Points& points, std::size_t count, Random& random) {
    Balls balls;
    for (const std::size_t seed : far_seeds(points, count, random)) {
        balls.push_back({points.x[seed], points.y[seed], points.z[seed], 0});
    }
    lloyd(points, balls, 5);
    return balls;
}

Balls grid(const Points& points, const std::array<Vec3, 3>& axes, const std::array<std::size_t, 3>& counts) {
    Box whole;
    for (std::size_t p = 0; p < points.size(); ++p) {
        whole.add(along(points.at(p), axes));
    }
    std::vector<Box> cells(counts[0] * counts[1] * counts[2]);
    for (std::size_t p = 0; p < points.size(); ++p) {
        const Vec3 place = along(points.at(p), axes);
        std::size_t cell = 0;
        for (int k = 2; k >= 0; --k) {
            const auto n = counts[static_cast<std::size_t>(k)];
            const double share = (place[k] - whole.low[k]) / std::max(whole.size()[k], 1e-9);
            cell = cell * n + std::min(n - 1, static_cast<std::size_t>(share * static_cast<double>(n)));
        }
        cells[cell].add(place);
    }
    Balls balls;
    for (const Box& cell : cells) {
        if (!cell.empty()) {
            const Vec3 c = cell.center();
            balls.push_back(ball_of({axes[0] * c.x + axes[1] * c.y + axes[2] * c.z, cell.diagonal() / 2}));
        }
    }
    return balls;
}

std::array<std::size_t, 3> most_cubic(const Points& points, const std::array<Vec3, 3>& axes, std::size_t count) {
    Box whole;
    for (std::size_t p = 0; p < points.size(); ++p) {
        whole.add(along(points.at(p), axes));
    }
    const Vec3 size = whole.size();
    std::array<std::size_t, 3> best{count, 1, 1};
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 1; i <= count; ++i) {
        for (std::size_t j = 1; i * j <= count; ++j) {
            const std::size_t k = count / (i * j);
            const double diagonal = norm(
                {size.x / static_cast<double>(i), size.y / static_cast<double>(j), size.z / static_cast<double>(k)});
            if (i * j * k == count && diagonal < least) {
                least = diagonal;
                best = {i, j, k};
            }
        }
    }
    return best;
}

std::array<Vec3, 3> axes_of(const Points& points) {
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (std::size_t p = 0; p < points.size(); ++p) {
        mean += Eigen::Vector3d(points.x[p], points.y[p], points.z[p]) / static_cast<double>(points.size());
    }
    Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
    for (std::size_t p = 0; p < points.size(); ++p) {
        const Eigen::Vector3d d = Eigen::Vector3d(points.x[p], points.y[p], points.z[p]) - mean;
        moments += d * d.transpose();
    }
    const Eigen::Matrix3d v = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(moments).eigenvectors();
    return {Vec3{v(0, 2), v(1, 2), v(2, 2)}, Vec3{v(0, 1), v(1, 1), v(2, 1)}, Vec3{v(0, 0), v(1, 0), v(2, 0)}};
}

Balls split(const Balls& balls, std::size_t i, const Points& points, const std::vector<float>& gaps, Random& random) {
    const Points owned = deepest_in(balls, i, points_within(points, balls[i], gaps));
    Balls result = balls;
    if (owned.size() < 2) {
        return result;
    }
    const Balls two = clusters(owned, 2, random);
    result[i] = two[0];
    result.push_back(two[1]);
    return result;
}

std::vector<Balls> grids(const Points& points, std::size_t count, std::size_t most_in_a_row) {
    constexpr std::array<Vec3, 3> frame_axes{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
    std::vector<Balls> result;
    for (const auto& axes : {frame_axes, axes_of(points)}) {
        result.push_back(grid(points, axes, most_cubic(points, axes, count)));
        if (count <= most_in_a_row) {
            result.push_back(grid(points, axes, {count, 1, 1}));
        }
    }
    return result;
}

} // namespace foam::search::by_spheres
