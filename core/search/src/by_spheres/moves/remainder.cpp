#include "by_spheres/moves/remainder.hpp"

#include <cmath>

namespace foam::inline search::by_spheres {
namespace {

/// Share of a radius outside a ball within which points count as contained: coordinates are in single precision. The
/// final growth closes the resulting gaps.
constexpr float slack = 2e-6f;

double squared_radius(const Ball& ball) {
    return static_cast<double>(ball.r) * ball.r;
}

} // namespace

Remainder::Remainder(const IndexedSurface& skin)
    : skin_(skin), place_(skin.points.size(), 0), corner_turn_(skin.points.size(), 0),
      edge_turn_(skin.edges.size(), 0) {}

void Remainder::find(const std::vector<std::uint32_t>& faces, const Balls& balls, const Ball* within,
                     Content& content) {
    within_ = within;
    content.clear();
    ++turn_;
    for (const std::uint32_t f : faces) {
        const IndexedSurface::Face& face = skin_.faces[f];
        if (!find_near(face, balls)) {
            continue;
        }
        if (near_.empty()) {
            add_whole(face, content);
        } else {
            add_part(face, content);
        }
    }
}

bool Remainder::find_near(const IndexedSurface::Face& face, const Balls& balls) {
    near_.clear();
    for (const Ball& ball : balls) {
        const float sum = ball.r + face.bounds.r;
        if (squared_distance(ball, face.bounds) > sum * sum) {
            continue;
        }
        const float squared = ball.r * ball.r * (1 + 2 * slack);
        int inside = 0;
        for (const std::uint32_t p : face.corners) {
            inside += ball.squared_distance(skin_.points.x[p], skin_.points.y[p], skin_.points.z[p]) <= squared;
        }
        if (inside == 3) {
            return false;
        }
        near_.push_back(ball);
    }
    return true;
}

bool Remainder::held(const Vec3& point, std::size_t but, std::size_t and_but) const {
    if (within_ && squared_norm(point - center_of(*within_)) > squared_radius(*within_)) {
        return true;
    }
    for (std::size_t i = 0; i < near_.size(); ++i) {
        if (i != but && i != and_but &&
            squared_norm(point - center_of(near_[i])) <= squared_radius(near_[i]) * (1 + 2 * slack)) {
            return true;
        }
    }
    return false;
}

std::uint32_t Remainder::corner(std::uint32_t point, Content& content) {
    if (corner_turn_[point] != turn_) {
        corner_turn_[point] = turn_;
        place_[point] = static_cast<std::uint32_t>(content.points.size());
        content.points.add(skin_.points, point);
    }
    return place_[point];
}

void Remainder::add_whole(const IndexedSurface::Face& face, Content& content) {
    for (const std::uint32_t e : face.edges) {
        if (edge_turn_[e] != turn_) {
            edge_turn_[e] = turn_;
            const std::uint32_t from = corner(skin_.edges[e].first, content);
            content.lines.push_back({from, corner(skin_.edges[e].second, content)});
        }
    }
}

void Remainder::add_part(const IndexedSurface::Face& face, Content& content) {
    found_.clear();
    const Vec3 corners[3]{skin_.points.at(face.corners[0]), skin_.points.at(face.corners[1]),
                          skin_.points.at(face.corners[2])};
    for (std::size_t k = 0; k < 3; ++k) {
        if (!held(corners[k])) {
            found_.push_back(corner(face.corners[k], content));
        }
        cross_edge(corners[k], corners[(k + 1) % 3], content);
    }
    cross_balls(corners[0], corners[1], corners[2], content);
    for (std::size_t i = 0; i < found_.size(); ++i) {
        for (std::size_t j = i + 1; j < found_.size(); ++j) {
            content.lines.push_back({found_[i], found_[j]});
        }
    }
}

void Remainder::add_found(const Vec3& point, Content& content) {
    found_.push_back(static_cast<std::uint32_t>(content.points.size()));
    content.points.add(point);
}

void Remainder::cross_edge(const Vec3& from, const Vec3& to, Content& content) {
    const Vec3 along = to - from;
    const double squared = squared_norm(along);
    if (!(squared > 0)) {
        return;
    }
    for (std::size_t i = 0; i < near_.size(); ++i) {
        const Vec3 start = from - center_of(near_[i]);
        const double half = dot(start, along);
        const double root = half * half - squared * (squared_norm(start) - squared_radius(near_[i]));
        if (!(root > 0)) {
            continue;
        }
        for (const double sign : {-1.0, 1.0}) {
            const double t = (-half + sign * std::sqrt(root)) / squared;
            if (t > 0 && t < 1 && !held(from + along * t, i)) {
                add_found(from + along * t, content);
            }
        }
    }
}

/// Finds where the circles in which two balls cut the face's plane meet inside the face.
void Remainder::cross_balls(const Vec3& a, const Vec3& b, const Vec3& c, Content& content) {
    constexpr double least_area = 1e-12;
    const Vec3 ab = b - a, ac = c - a, across = cross(ab, ac);
    const double twice = norm(across);
    if (near_.size() < 2 || !(twice > least_area)) {
        return;
    }
    const Vec3 normal = across / twice;
    const auto inside = [&](const Vec3& p) {
        const double s = dot(cross(p - a, ac), normal), t = dot(cross(ab, p - a), normal);
        return s >= 0 && t >= 0 && s + t <= twice;
    };
    for (std::size_t i = 0; i < near_.size(); ++i) {
        const double height = dot(center_of(near_[i]) - a, normal);
        const double squared = squared_radius(near_[i]) - height * height;
        const Vec3 middle = center_of(near_[i]) - normal * height;
        for (std::size_t j = i + 1; j < near_.size() && squared > 0; ++j) {
            const double other_height = dot(center_of(near_[j]) - a, normal);
            const double other_squared = squared_radius(near_[j]) - other_height * other_height;
            const Vec3 to_other = center_of(near_[j]) - normal * other_height - middle;
            const double apart = squared_norm(to_other);
            if (!(other_squared > 0 && apart > 0)) {
                continue;
            }
            const double along = (apart + squared - other_squared) / (2 * apart);
            const double root = squared / apart - along * along;
            if (!(root > 0)) {
                continue;
            }
            for (const double sign : {-1.0, 1.0}) {
                const Vec3 p = middle + to_other * along + cross(normal, to_other) * (sign * std::sqrt(root));
                if (inside(p) && !held(p, i, j)) {
                    add_found(p, content);
                }
            }
        }
    }
}

} // namespace foam::inline search::by_spheres
