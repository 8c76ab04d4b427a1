// What versions of the format after 1.9 say of shapes, and libsdformat 12 does not read.
#pragma once

#include "document.hpp"

#include <foam/geometry/mesh.hpp>

#include <sdf/Mesh.hh>

#include <map>
#include <memory>
#include <optional>

namespace foam::load_sdf {

/// Returns a mesh that holds the cone, whose tip is above: a round one has no kind of element.
Mesh cone_mesh(double radius, double length);

/// The texts that meshes stand in.
class Optimizations {
public:
    explicit Optimizations(const std::string& main_text) : main_text_(main_text) {}

    /// Returns whether a mesh collides as its convex hull: optimization="convex_hull".
    bool is_hull(const ::sdf::Mesh& mesh, const Document& document);

private:
    struct Text;
    const Text& text_of(const Place& place, const Document& document);

    const std::string& main_text_;
    std::map<std::filesystem::path, std::shared_ptr<const Text>> texts_;
};

} // namespace foam::load_sdf
