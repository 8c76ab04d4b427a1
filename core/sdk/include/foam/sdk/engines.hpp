// The programs that collide with what foam writes, and what each makes of shapes in a file: --for ENGINE.
#pragma once

#include <foam/geometry/element.hpp>
#include <foam/geometry/elements.hpp>
#include <foam/sdk/parameter.hpp>
#include <foam/sdk/stage.hpp>

#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] sdk {

struct LinkSpheres;

/// A program that collides with elements. What it takes away of a shape is measured by tests/python/consumers, in the
/// version that the title names.
struct Engine {
    std::string_view name;                 ///< of --for: "pybullet"
    std::string_view title;                ///< "PyBullet 3.2.7"
    std::vector<std::string_view> writers; ///< of files that it reads, the best first: "write.urdf"
    std::vector<Element::Kind> kinds;      ///< that collide in it
    std::size_t most_hull_vertices = 0;    ///< more are cut away, or refused; 0: any number
    /// Returns the element that a file has to state, so that the engine's body contains the given one; null: itself.
    Element (*stated)(Element) = nullptr;
    /// Returns a body that lies in what the engine makes of an element in a file. Precondition: `stated` made it.
    Element (*held)(Element) = nullptr;
    ElementCost cost{};        ///< of a check of two elements, measured by apps/bench
    std::string_view loss{};   ///< what it takes away, and what foam adds: whole sentences; empty: nothing
    std::string_view advice{}; ///< what a user has to do beside loading the file; empty: nothing
};

/// Returns all engines, by name.
std::span<const Engine> engines();
/// Returns the engine. Throws Error(usage), naming those that there are.
const Engine& engine_named(std::string_view name);

/// The parameter "engine" of writers: the program that the file is for. Default: any.
Parameter engine_parameter(std::string_view writer);
/// Returns its engine; null for any.
const Engine* engine_of(const Parameters& parameters);

/// Returns the elements that a file for the engine states; the same for null. Throws Error(output), naming link and
/// remedy, for a kind or a number of vertices that the engine does not collide.
std::vector<LinkSpheres> stated_for(const Engine* engine, std::vector<LinkSpheres> links);
/// Returns what the engine holds of the elements of a file; the same for null.
std::map<std::string, Elements> held_by(const Engine* engine, std::map<std::string, Elements> links);

} // namespace sdk
} // namespace foam
