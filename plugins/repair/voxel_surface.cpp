#include "octree.hpp"

#include "soup.hpp"

#include <foam/base/cancellation.hpp>

#include <numeric>
#include <unordered_map>

namespace foam::repair {
namespace {

/// One of the six directions: axis and sign.
struct Direction {
    std::size_t axis;
    std::int32_t sign;
    std::uint64_t number() const { return 2 * axis + (sign > 0); }
};

Cell moved(Cell cell, Direction d, std::int32_t steps = 1) {
    cell[d.axis] += steps * d.sign;
    return cell;
}

Direction opposite(Direction d) {
    return {d.axis, -d.sign};
}

/// A face of a solid cell next to an outside one.
struct Face {
    Cell cell;
    Direction direction;
};

/// Returns the corners, counter-clockwise seen from outside; side k leads from corner k to corner k + 1.
std::array<Cell, 4> corner_points(const Face& face) {
    const std::size_t u = (face.direction.axis + 1) % 3, v = (face.direction.axis + 2) % 3;
    Cell origin = face.cell;
    origin[face.direction.axis] += face.direction.sign > 0;
    std::array<Cell, 4> points = {origin, origin, origin, origin};
    const bool up = face.direction.sign > 0;
    points[1][up ? u : v] += 1;
    points[2][u] += 1;
    points[2][v] += 1;
    points[3][up ? v : u] += 1;
    return points;
}

/// Returns the direction in the face's plane that leads out of it over side k.
Direction across(const Face& face, std::size_t k) {
    const std::size_t u = (face.direction.axis + 1) % 3, v = (face.direction.axis + 2) % 3;
    const std::array<Direction, 4> up = {Direction{v, -1}, {u, 1}, {v, 1}, {u, -1}};
    const std::array<Direction, 4> down = {Direction{u, -1}, {v, 1}, {u, 1}, {v, -1}};
    return face.direction.sign > 0 ? up[k] : down[k];
}

class Extraction {
public:
    Extraction(const Octree& octree, Context& context) : octree_(octree), context_(context) {}

    VoxelSurface run() {
        collect_faces();
        join_corners();
        number_vertices();
        make_triangles();
        return std::move(result_);
    }

private:
    static std::uint64_t key(const Face& face) {
        const auto part = [&](std::size_t axis) { return static_cast<std::uint64_t>(face.cell[axis]); };
        return ((part(0) << 20 | part(1)) << 20 | part(2)) << 3 | face.direction.number();
    }

    void collect_faces() {
        CancellationCounter asking(4096);
        for (const Node& node : octree_.nodes()) {
            asking.check();
            if (node.state == State::occupied || node.state == State::filled) {
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    collect_side(node, {axis, -1});
                    collect_side(node, {axis, 1});
                }
            }
        }
        for (std::uint32_t i = 0; i < faces_.size(); ++i) {
            asking.check();
            index_.emplace(key(faces_[i]), i);
        }
    }

    /// Collects the faces on one side of a leaf, which may be many cells long.
    void collect_side(const Node& node, Direction d) {
        const std::int32_t across_count = octree_.cells_across(node);
        Cell corner = octree_.low_cell(node);
        corner[d.axis] += d.sign > 0 ? across_count - 1 : 0;
        for (std::int32_t i = 0; i < across_count; ++i) {
            for (std::int32_t j = 0; j < across_count; ++j) {
                Cell cell = corner;
                cell[(d.axis + 1) % 3] += i;
                cell[(d.axis + 2) % 3] += j;
                if (!octree_.is_solid(moved(cell, d))) {
                    faces_.push_back({cell, d});
                }
            }
        }
    }

    /// Returns the next face over side k, if solid cells are joined across faces only. `pinched`: another pair of faces
    /// has the same edge.
    std::uint32_t next_face(std::uint32_t i, std::size_t k, bool& pinched) const {
        const Face& face = faces_[i];
        const Direction t = across(face, k);
        const Cell beside = moved(face.cell, t);
        const Cell above = moved(beside, face.direction);
        const bool above_is_solid = octree_.is_solid(above);
        if (!octree_.is_solid(beside)) {
            pinched = above_is_solid;
            return index_.at(key({face.cell, t}));
        }
        pinched = false;
        return index_.at(above_is_solid ? key({above, opposite(t)}) : key({beside, face.direction}));
    }

    std::uint32_t find(std::uint32_t corner) {
        while (parent_[corner] != corner) {
            corner = parent_[corner] = parent_[parent_[corner]];
        }
        return corner;
    }

    /// Merges the corners of faces that are neighbours over an edge into one vertex.
    void join_corners() {
        parent_.resize(4 * faces_.size());
        std::iota(parent_.begin(), parent_.end(), 0u);
        midpoint_.assign(4 * faces_.size(), no_index);
        for (std::uint32_t i = 0; i < faces_.size(); ++i) {
            if (i % 65536 == 0) {
                context_.check_cancelled();
            }
            const std::array<Cell, 4> mine = corner_points(faces_[i]);
            for (std::size_t k = 0; k < 4; ++k) {
                bool pinched = false;
                const std::uint32_t j = next_face(i, k, pinched);
                const std::array<Cell, 4> theirs = corner_points(faces_[j]);
                for (std::uint32_t m = 0; m < 4; ++m) {
                    for (const std::size_t end : {k, (k + 1) % 4}) {
                        if (theirs[m] == mine[end]) {
                            const std::uint32_t a = find(4 * i + static_cast<std::uint32_t>(end)), b = find(4 * j + m);
                            parent_[std::max(a, b)] = std::min(a, b);
                        }
                    }
                    if (pinched && theirs[m] == mine[(k + 1) % 4] && theirs[(m + 1) % 4] == mine[k]) {
                        midpoint_[4 * i + k] =
                            std::min<std::uint32_t>(4 * i + static_cast<std::uint32_t>(k), 4 * j + m);
                    }
                }
            }
        }
    }

    std::uint32_t add_vertex(const Vec3& point, const Face& face) {
        result_.mesh.vertices.push_back(point * octree_.cell_size());
        result_.cells.push_back({face.cell});
        return static_cast<std::uint32_t>(result_.mesh.vertices.size() - 1);
    }

    void add_cell(std::uint32_t vertex, const Cell& cell) {
        std::vector<Cell>& cells = result_.cells[vertex];
        if (std::find(cells.begin(), cells.end(), cell) == cells.end()) {
            cells.push_back(cell);
        }
    }

    static Vec3 point(const Cell& c) { return Vec3{double(c[0]), double(c[1]), double(c[2])}; }

    void number_vertices() {
        vertex_.assign(parent_.size(), no_index);
        middle_vertex_.assign(parent_.size(), no_index);
        for (std::uint32_t corner = 0; corner < parent_.size(); ++corner) {
            const Face& face = faces_[corner / 4];
            const std::array<Cell, 4> points = corner_points(face);
            const std::size_t k = corner % 4;
            const std::uint32_t root = find(corner);
            if (root == corner) {
                vertex_[corner] = add_vertex(point(points[k]), face);
            } else {
                vertex_[corner] = vertex_[root];
                add_cell(vertex_[corner], face.cell);
            }
            if (midpoint_[corner] == corner) {
                middle_vertex_[corner] = add_vertex((point(points[k]) + point(points[(k + 1) % 4])) * 0.5, face);
            } else if (midpoint_[corner] != no_index) {
                middle_vertex_[corner] = middle_vertex_[midpoint_[corner]];
                add_cell(middle_vertex_[corner], face.cell);
            }
        }
    }

    void make_triangles() {
        CancellationCounter asking(4096);
        for (std::uint32_t i = 0; i < faces_.size(); ++i) {
            asking.check();
            std::vector<std::uint32_t> outline;
            for (std::uint32_t side = 4 * i; side < 4 * i + 4; ++side) {
                outline.push_back(vertex_[side]);
                if (middle_vertex_[side] != no_index) {
                    outline.push_back(middle_vertex_[side]);
                }
            }
            std::vector<Triangle>& triangles = result_.mesh.triangles;
            if (outline.size() == 4) {
                result_.quads.push_back(
                    {{outline[0], outline[1], outline[2], outline[3]}, static_cast<std::uint32_t>(triangles.size())});
                triangles.push_back({outline[0], outline[1], outline[2]});
                triangles.push_back({outline[2], outline[3], outline[0]});
                continue;
            }
            const std::array<Cell, 4> points = corner_points(faces_[i]);
            const std::uint32_t center = add_vertex((point(points[0]) + point(points[2])) * 0.5, faces_[i]);
            for (std::size_t k = 0; k < outline.size(); ++k) {
                triangles.push_back({outline[k], outline[(k + 1) % outline.size()], center});
            }
        }
    }

    const Octree& octree_;
    Context& context_;
    std::vector<Face> faces_;
    std::unordered_map<std::uint64_t, std::uint32_t> index_; // looked up, never iterated
    std::vector<std::uint32_t> parent_;                      // of corners, 4 · face + place
    std::vector<std::uint32_t> midpoint_;                    // of sides: the side whose midpoint it shares
    std::vector<std::uint32_t> vertex_, middle_vertex_;
    VoxelSurface result_;
};

} // namespace

VoxelSurface voxel_surface(const Octree& octree, Context& context) {
    return Extraction(octree, context).run();
}

} // namespace foam::repair
