// The part of a surface outside some balls.
#pragma once

#include "cover/measured/indexed_surface.hpp"

namespace foam::inline search::cover {

/// Points whose convex hulls, face by face, contain pieces of a surface; the lines between them are where a plane may
/// cut the hulls.
struct Content {
    Points points;
    std::vector<Line> lines;

    void clear() {
        points.clear();
        lines.clear();
    }
};

/// The part of faces outside balls: for each face the extreme points of the part outside all the balls. A ball is
/// convex, so these are corners, crossings of edges with balls, and places where two balls cross in the face. A ball
/// that contains them contains the whole remainder. Pieces thinner than rounding are left out.
class Remainder {
public:
    /// The skin must outlive this.
    explicit Remainder(const IndexedSurface& skin);

    void find(const std::vector<std::uint32_t>& faces, const Balls& balls, Content& content) {
        find(faces, balls, nullptr, content);
    }
    /// Finds the part within a ball: only balls that meet it matter.
    void find_within(const Ball& within, const std::vector<std::uint32_t>& faces, const Balls& balls,
                     Content& content) {
        find(faces, balls, &within, content);
    }

private:
    void find(const std::vector<std::uint32_t>& faces, const Balls& balls, const Ball* within, Content& content);
    /// Returns false if one of the balls contains the whole face. Otherwise near_ are the balls that may contain a
    /// part.
    bool find_near(const IndexedSurface::Face& face, const Balls& balls);
    /// Returns whether a ball contains the point, or whether it is not wanted.
    bool held(const Vec3& point, std::size_t but = SIZE_MAX, std::size_t and_but = SIZE_MAX) const;
    std::uint32_t corner(std::uint32_t point, Content& content);
    void add_whole(const IndexedSurface::Face& face, Content& content);
    void add_part(const IndexedSurface::Face& face, Content& content);
    void cross_edge(const Vec3& from, const Vec3& to, Content& content);
    void cross_balls(const Vec3& a, const Vec3& b, const Vec3& c, Content& content);
    void add_found(const Vec3& point, Content& content);

    const IndexedSurface& skin_;
    // Marks of the points in the content: the turn in which they were added.
    std::vector<std::uint32_t> place_, corner_turn_, edge_turn_;
    std::uint32_t turn_ = 0;
    const Ball* within_ = nullptr; ///< places outside it are not wanted; null: all are
    Balls near_;
    std::vector<std::uint32_t> found_; ///< of the face's, in the content
};

} // namespace foam::inline search::cover
