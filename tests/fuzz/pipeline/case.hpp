// A case: everything that a run is given, made from a seed.
#pragma once

#include <foam/recipe/recipe.hpp>

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

namespace foam::fuzz {

struct Case {
    std::uint64_t seed = 0;
    std::map<std::string, std::string> files; ///< geometry and the recipe, recipe.yaml, by name
    std::string input;                        ///< the mesh or the URDF among them
    bool robot = false;
    std::size_t threads = 1;
    bool cached = false; ///< the run may use a cache
    bool again = false;  ///< run it on another number of threads, too, and compare the bytes
};

struct CaseOptions {
    bool odd_numbers = true; ///< some cases have numbers that no robot has
    bool elements = false;   ///< elements of any kind instead of spheres
};

/// The same seed, options and stages give the same case.
Case make_case(std::uint64_t seed, const Registry& registry, const CaseOptions& options);

/// Writes its files. Then `foam run FOLDER/recipe.yaml` does what run_case() does.
void write_case(const Case& made, const std::filesystem::path& folder);

} // namespace foam::fuzz
