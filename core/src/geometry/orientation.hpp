// Which way a raw mesh's triangles face, and which of them count when inside is asked.
#pragma once

#include <foam/mesh.hpp>

#include <vector>

namespace foam::geometry {

/// What becomes of a raw triangle when inside is asked. Its shape always stays part of the surface.
enum class Facing : signed char {
    as_given, ///< counts as it is wound
    flipped,  ///< counts with two corners swapped
    ignored,  ///< does not count: degenerate, a copy, or one of two that cancel
};

/// The reading of a raw mesh as a solid.
struct Reading {
    std::vector<Facing> facing; ///< one a triangle
    /// The triangles that count bound a solid without holes: every edge is passed as often one way as the other, so the
    /// winding number is a whole number everywhere off the surface.
    bool closed = false;
};

/// Reads a mesh the way its author must have meant it:
/// - corners at identical positions are one vertex;
/// - equal faces of one winding count once; two of opposite winding cancel (a face between two bodies). Where that
/// would
///   cancel most of a component (double-sided faces), one of each pair is kept if that gives a closed, orientable
///   surface; otherwise the component is surface only: it has no inside;
/// - neighbours wound against each other are turned the way the larger area of their patch is wound; one-sided surfaces
///   (Möbius) stay as given;
/// - a mesh with negative signed volume is inside out and is turned; after that a closed shell with negative volume is
/// a
///   cavity if it lies in another shell, and is turned if it does not. Nested shells of one winding are a union.
Reading read_as_solid(const Mesh& mesh);

} // namespace foam::geometry
