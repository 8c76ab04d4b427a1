#include "collapsing_hull.hpp"

#include <foam/base/cancellation.hpp>

#include <algorithm>
#include <cmath>

namespace foam::inline search::convex {

CollapsingHull::CollapsingHull(std::span<const Vec3> points, std::span<const geometry::HullTriangle> triangles)
    : points_(points.begin(), points.end()), face_at_(points.size(), none), versions_(points.size(), 0),
      begin_(points.size(), none) {
    for (const geometry::HullTriangle& t : triangles) {
        const std::uint32_t i = add_face(t.corners[0], t.corners[1], t.corners[2]);
        faces_[i].across = t.across;
    }
    count_ = static_cast<std::size_t>(
        std::count_if(face_at_.begin(), face_at_.end(), [](std::uint32_t face) { return face != none; }));
}

std::vector<Vec3> CollapsingHull::vertices() const {
    std::vector<Vec3> result;
    for (std::uint32_t v = 0; v < points_.size(); ++v) {
        if (is_vertex(v)) {
            result.push_back(points_[v]);
        }
    }
    return result;
}

bool CollapsingHull::reduce_to(std::size_t most) {
    CancellationCounter asking(64);
    bool all_offered = false;
    while (count_ > most) {
        asking.check();
        if (queue_.empty()) {
            if (all_offered) {
                return false;
            }
            offer_all();
            all_offered = true;
            continue;
        }
        const Collapse next = queue_.top();
        queue_.pop();
        if (!is_vertex(next.a) || !is_vertex(next.b)) {
            continue;
        }
        if (next.version != version_of(next.a, next.b)) {
            offer(next.a, next.b);
        } else if (collapse(next)) {
            all_offered = false;
        }
    }
    return true;
}

std::size_t CollapsingHull::index_in(std::uint32_t face, std::uint32_t v) const {
    const auto& corners = faces_[face].corners;
    return corners[0] == v ? 0 : corners[1] == v ? 1 : 2;
}

std::uint32_t CollapsingHull::add_face(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    std::uint32_t i = static_cast<std::uint32_t>(faces_.size());
    if (free_.empty()) {
        faces_.emplace_back();
    } else {
        i = free_.back();
        free_.pop_back();
    }
    Face& face = faces_[i];
    face = {.corners = {a, b, c}};
    const Vec3 across = cross(points_[b] - points_[a], points_[c] - points_[a]);
    const double length = norm(across);
    face.area = length / 2;
    face.normal = length > 0 ? across / length : Vec3{};
    face.offset = dot(face.normal, points_[a]);
    for (const std::uint32_t v : face.corners) {
        face_at_[v] = i;
    }
    return i;
}

void CollapsingHull::offer_all() {
    for (std::uint32_t i = 0; i < faces_.size(); ++i) {
        for (std::size_t k = 0; k < 3 && faces_[i].alive; ++k) {
            const std::uint32_t a = faces_[i].corners[k], b = faces_[i].corners[(k + 1) % 3];
            if (a < b) {
                offer(a, b);
            }
        }
    }
}

bool CollapsingHull::look_from(std::uint32_t a, std::uint32_t b) {
    ++look_;
    visible_.clear();
    bool edge = false;
    for (const std::uint32_t end : {a, b}) {
        std::uint32_t face = face_at_[end];
        do {
            if (faces_[face].seen != look_) {
                faces_[face].seen = look_;
                visible_.push_back(face);
            }
            const std::size_t before = (index_in(face, end) + 2) % 3;
            edge = edge || faces_[face].corners[before] == b;
            face = faces_[face].across[before];
        } while (face != face_at_[end]);
    }
    return edge;
}

void CollapsingHull::offer(std::uint32_t a, std::uint32_t b) {
    constexpr double reach = 4;         // in a hull of the size 1, farther points add too much
    constexpr double least_area = 1e-9; // the normals of smaller triangles are uncertain
    if (!look_from(a, b)) {
        return;
    }
    static thread_local std::vector<HalfSpace> planes;
    planes.clear();
    for (const std::uint32_t i : visible_) {
        if (const Face& face = faces_[i]; face.area > least_area) {
            planes.push_back({face.normal, face.offset, face.area});
        }
    }
    if (const std::optional<Vec3> to = least_beyond(planes, reach)) {
        queue_.push({look_at(*to), a, b, version_of(a, b), *to});
    }
}

double CollapsingHull::look_at(const Vec3& p) {
    double volume = 0;
    for (std::size_t n = 0; n < visible_.size(); ++n) {
        const Face& face = faces_[visible_[n]];
        volume += face.area * std::max(dot(face.normal, p) - face.offset, 0.0) / 3;
        for (const std::uint32_t k : face.across) {
            if (Face& other = faces_[k]; other.seen != look_ && dot(other.normal, p) > other.offset) {
                other.seen = look_;
                visible_.push_back(k);
            }
        }
    }
    return volume;
}

bool CollapsingHull::find_horizon(const Vec3& p) {
    horizon_.clear();
    for (const std::uint32_t i : visible_) {
        const Face& face = faces_[i];
        for (std::size_t k = 0; k < 3; ++k) {
            if (faces_[face.across[k]].seen != look_) {
                horizon_.push_back({face.corners[k], face.corners[(k + 1) % 3], face.across[k]});
            }
        }
    }
    for (const HorizonEdge& edge : horizon_) {
        begin_[edge.from] = none;
    }
    for (std::uint32_t i = 0; i < horizon_.size(); ++i) {
        const HorizonEdge& edge = horizon_[i];
        constexpr double narrow = 1e-13;
        if (begin_[edge.from] != none ||
            norm(cross(points_[edge.to] - points_[edge.from], p - points_[edge.from])) < narrow) {
            return false;
        }
        begin_[edge.from] = i;
    }
    std::size_t around = 0;
    for (std::uint32_t i = 0; around == 0 || i != 0; ++around) {
        i = begin_[horizon_[i].to];
    }
    return around == horizon_.size();
}

void CollapsingHull::replace_visible(const Vec3& p) {
    const auto apex = static_cast<std::uint32_t>(points_.size());
    points_.push_back(p);
    face_at_.push_back(none);
    versions_.push_back(0);
    begin_.push_back(none);
    for (const std::uint32_t i : visible_) {
        faces_[i].alive = false;
        free_.push_back(i);
        for (const std::uint32_t v : faces_[i].corners) {
            count_ -= is_vertex(v) ? 1 : 0;
            face_at_[v] = none;
        }
    }
    count_ += horizon_.size() + 1;
    std::vector<std::uint32_t> made;
    for (const HorizonEdge& edge : horizon_) {
        const std::uint32_t i = add_face(edge.from, edge.to, apex);
        faces_[i].across[0] = edge.beyond;
        faces_[edge.beyond].across[index_in(edge.beyond, edge.to)] = i;
        made.push_back(i);
    }
    for (std::size_t k = 0; k < horizon_.size(); ++k) {
        const std::uint32_t next = made[begin_[horizon_[k].to]];
        faces_[made[k]].across[1] = next;
        faces_[next].across[2] = made[k];
    }
}

bool CollapsingHull::collapse(const Collapse& next) {
    look_from(next.a, next.b);
    const double added = look_at(next.to); // its surroundings may have changed
    if (added > next.added * (1 + 1e-9)) {
        queue_.push({added, next.a, next.b, next.version, next.to});
        return false;
    }
    if (!find_horizon(next.to)) {
        return false;
    }
    replace_visible(next.to);
    const auto apex = static_cast<std::uint32_t>(points_.size() - 1);
    // Other edges of these points are looked at again when it is their turn: what they add hardly falls.
    for (const HorizonEdge& edge : horizon_) {
        ++versions_[edge.from];
    }
    for (const HorizonEdge& edge : horizon_) {
        offer(edge.from, apex);
    }
    return true;
}

} // namespace foam::inline search::convex
