// The orientation of a raw mesh's triangles, and which of them count for the inside.
#pragma once

#include <foam/geometry/mesh.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace foam::inline geometry {

/// The role of a raw triangle in inside tests. Its shape always stays part of the surface.
enum class Facing : signed char {
    as_given, ///< counts as it is wound
    flipped,  ///< counts with two corners swapped
    ignored,  ///< does not count: degenerate, a copy, or one of two that cancel
};

/// An edge that the triangles pass `times` more often from `from` to `to` than back. Of corners at one place, the first
/// vertex names both.
struct RimEdge {
    std::uint32_t from, to;
    std::ptrdiff_t times;
};

/// The interpretation of a raw mesh as a solid.
struct Reading {
    std::vector<Facing> facing; ///< one per triangle
    /// Whether the triangles that count bound a solid without holes: every edge is passed as often one way as the
    /// other, so the winding number is a whole number everywhere off the surface.
    bool closed = false;
    std::vector<RimEdge> rim{}; ///< around the triangles that count, in order of the edges; empty if closed
};

/// Interprets a mesh as its author must have meant it:
/// - corners at identical positions are one vertex;
/// - equal faces of one winding count once; two of opposite winding cancel (a face between two bodies). Where that
///   would cancel most of a component (double-sided faces), one of each pair is kept if that gives a closed, orientable
///   surface; otherwise the component is surface only: it has no inside;
/// - adjacent triangles of opposite winding get the winding of the larger area of their patch; one-sided surfaces
///   (Möbius) stay as given;
/// - a mesh with negative signed volume is inside out and is flipped. Then a closed shell with negative volume is a
///   cavity if it lies in another shell, and is flipped if it does not. Nested shells of one winding are a union.
Reading read_as_solid(const Mesh& mesh);

/// Returns a surface over the rim of the triangles that count, wound so that both together pass every edge as often one
/// way as the other. Their winding number is then a whole number, which the crossings of a line determine. The winding
/// number of the triangles is this number minus that of the closing surface, which is small where holes are (as the
/// integral over the boundary in Martens and Bessmeltsev 2025, One-Shot Method for Computing Generalized Winding
/// Numbers).
///
/// Any such surface is correct; one of small area is best. Ribbons join corners of the rim that nearly coincide, so
/// that the two sides of a crack cancel. The remaining edges form closed curves, each filled with a fan of triangles to
/// its centroid. Empty if the surface is closed.
Mesh closing_surface(const Mesh& mesh, const Reading& reading);

} // namespace foam::inline geometry
