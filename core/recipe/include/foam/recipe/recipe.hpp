// Recipes: the input and the stages of a run, read from YAML. Every value has the place it came from. A recipe is
// checked completely before any data is touched.
#pragma once

#include <foam/geometry/clip_plane.hpp>
#include <foam/geometry/solid.hpp>
#include <foam/geometry/sphere.hpp>
#include <foam/recipe/mesh_unit.hpp>
#include <foam/recipe/plain_length.hpp>
#include <foam/robot/robot.hpp>
#include <foam/sdk/model.hpp>
#include <foam/sdk/registry.hpp>
#include <foam/sdk/stage.hpp>
#include <foam/yaml/findings.hpp>

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] recipe {

using yaml::Diagnostic;
using yaml::Location;

/// One stage of a recipe with checked parameters.
struct StageCall {
    std::string stage;
    std::map<std::string, ParameterValue> given; ///< as in the recipe; the stage adds the defaults
    Location where;
    Isolation isolation{}; ///< mesh loaders, mesh filters and spherizers
};

/// The quantity of a link whose sum over the links the allocation of spheres makes least.
enum class Share {
    volume,     ///< its excess volume
    even,       ///< its excess: that volume / the volume of its geometry
    protrusion, ///< its mean protrusion: that volume / the area of its geometry
};

/// Returns the words in recipes, in the order of the enumeration.
const std::vector<std::string>& words_of_share();

/// What the allocation of elements serves.
enum class BudgetFor {
    geometry, ///< the sum of `Share`
    poses,    ///< then also few false contacts of links in random poses
};

/// The inside of hollow geometry in figures and in the allocation; the proof is of the geometry as it is.
enum class Hollow {
    keep, ///< as it is: empty
    fill, ///< counts as geometry
};

/// Overrides for the links that match a glob ("*finger"): parameters of stages of the chain, or skip.
struct LinkOverride {
    std::string glob;
    std::optional<bool> skip;
    std::optional<bool> no_collision; ///< the output has no collision geometry for the link
    std::vector<StageCall> stages; ///< merged into the chain's stages of the same name
    std::optional<std::size_t> spheres; ///< both of the following
    std::optional<std::size_t> min_spheres, max_spheres;
    std::optional<double> weight, max_protrusion; ///< max_protrusion: m
    std::optional<double> pad;                    ///< m
    std::optional<Hollow> hollow;
    std::optional<Covers> covers;
    std::optional<std::vector<Sphere>> keep;      ///< in the link's frame
    std::optional<std::vector<ClipPlane>> clip;   ///< in the link's frame
    Location where;
};

struct OutputCall {
    StageCall writer;
    std::string file;   ///< relative to the run directory
    std::string into{}; ///< the file whose spheres are replaced, relative to the recipe; empty: a whole file
    Location into_where{};
};

/// Returns the word in recipes: outer, inner or fitted.
const char* to_string(Guarantee guarantee);

enum class OnError { stop, skip, fallback };

/// The numbers on which the guarantee is proved.
enum class Numbers {
    float64, ///< those that are written, as double precision
    float32, ///< also those that a program holds that reads them in single precision
};

/// A file that a recipe was read from, with its text at that time.
struct RecipeFile {
    std::filesystem::path file;
    std::string text;
};

/// The stages from a mesh to its spheres.
struct StageChain {
    std::vector<StageCall> filters; ///< mesh filters in order
    StageCall spherizer;
    std::vector<StageCall> refiners; ///< in order, after the spherizer

    /// Returns all of them in order.
    std::vector<const StageCall*> stages() const;
    std::vector<StageCall*> stages();
};

/// A checked recipe. Absent optional values have the default that the documentation states.
struct Recipe : StageChain {
    std::filesystem::path file;       ///< empty for a recipe made in memory
    std::string source;               ///< its text
    std::vector<RecipeFile> extended; ///< the files that it extends, nearest first
    std::string variant;              ///< the chosen one; empty: the recipe itself
    std::string name;
    std::uint64_t seed = 0;
    /// Candidates; the first that resolves is used. Either robots (URDF) or single meshes.
    std::vector<std::string> urdf;
    std::vector<std::string> mesh;
    MeshUnit mesh_unit; ///< of single meshes
    Location input_where;
    RobotFacts facts;     ///< for formats that state more than the URDF
    Location facts_where; ///< of the robot
    /// The precision of the numbers that are proved: absent: float32 if a consumer of an output holds such numbers.
    std::optional<Numbers> numbers;
    std::vector<std::string> package_path; ///< searched before the environment; relative to the recipe
    std::vector<std::string> plugins;      ///< files to load; relative to the recipe
    std::vector<StageCall> loaders;        ///< parameters of loaders; the input's ending selects the loader
    std::string preferred_loader;          ///< the one with precedence where several read an ending; may be empty
    bool per_link = true;                        ///< false: spherize every collision element separately
    std::optional<std::size_t> budget_spheres;   ///< elements of any kind over the whole robot, at most
    bool budget_in_elements = false;             ///< the recipe says `elements`, not `spheres`
    std::optional<double> budget_cost;           ///< of the checks of all elements of the whole robot, at most
    ElementCost costs;                           ///< of the check of an element
    std::optional<double> budget_excess;         ///< of the whole robot; at most as many spheres as that needs
    std::optional<double> budget_max_protrusion; ///< m; of each link without its own value
    std::optional<double> budget_time_limit;     ///< s; the search for better spheres ends then
    std::optional<Share> budget_share;           ///< absent: volume
    std::optional<BudgetFor> budget_for;         ///< absent: geometry
    std::optional<CoveredGeometry> cover;        ///< of a robot; absent: its collision geometry
    std::optional<double> pad;                   ///< m; added to all radii
    std::optional<Hollow> hollow;                ///< absent: keep
    std::optional<Covers> covers;                ///< absent: solid
    Guarantee guarantee = Guarantee::outer;
    bool self_collision = false;     ///< keep links apart whose geometry is apart in this pose
    Location self_collision_where;   ///< of the pose
    JointValues self_collision_pose; ///< rad or m; of joints that are not named: zero, or the limit nearest to it
    std::vector<LinkOverride> links;
    std::vector<OutputCall> outputs;
    bool snapshots = false;
    std::array<int, 2> snapshot_size{1280, 960};
    StageCall renderer; ///< stage empty: snapshot.osmesa
    JointValues pose;   ///< of the robot's snapshot
    Location pose_where;
    bool debug_meshes = false, debug_snapshots = false;
    OnError on_error = OnError::stop;
    bool strict = false; ///< a glob that names no link is an error, not a warning
    Isolation isolation; ///< of the stages without their own setting
    std::vector<PlainLength> plain_lengths; ///< those of the text

    /// The settings for one link: the chain with the overrides and the recipe's isolation merged in.
    struct LinkRecipe : StageChain {
        bool skip = false;         ///< it gets no spheres
        bool no_collision = false; ///< nor has it collision geometry in the output
        std::size_t min_spheres = 1;
        std::optional<std::size_t> max_spheres;
        double weight = 1;                    ///< of its symmetric difference in the allocation
        std::optional<double> max_protrusion; ///< m
        std::vector<ClipPlane> clip;          ///< in the link's frame
        double pad = 0;                       ///< m
        Hollow hollow = Hollow::keep;
        Covers covers = Covers::solid;
        std::vector<Sphere> keep; ///< in the link's frame; they count as spheres of the link
    };
    LinkRecipe for_link(const std::string& link) const;
    /// Returns the precision that the recipe states, or that the consumers of its outputs need.
    Numbers proved_numbers(const Registry& registry) const;
    /// Returns the recipe's call of a loader, the recipe's isolation merged in.
    StageCall loader_call(const std::string& stage) const;
};

/// The result of reading a recipe. `recipes` has one entry per requested variant and point of its sweep; use it only if
/// the findings contain no error.
struct RecipeResult {
    std::vector<Recipe> recipes;
    std::vector<std::string> variants; ///< all variants of the recipe, chosen or not
    std::vector<Diagnostic> diagnostics;
    bool ok() const;
};

/// One `--set key.path=value`.
using Setting = std::pair<std::string, std::string>;

/// Reads and checks a recipe with the files that it extends. Never throws for errors in the text: all findings are
/// returned at once. Plugins that the recipe names are loaded into the registry first. `variants`: names or globs of
/// those to run; none: the recipe itself. The others are checked too.
RecipeResult read_recipe(const std::filesystem::path& file, Registry& registry,
                         const std::vector<Setting>& settings = {}, const std::vector<std::string>& variants = {});
RecipeResult parse_recipe(const std::string& text, const std::filesystem::path& file, Registry& registry,
                          const std::vector<Setting>& settings = {}, const std::vector<std::string>& variants = {});

/// Returns the recipe as YAML with every default written out; parse_recipe() of it gives an equal recipe. References to
/// files stay as they are; with `absolute_paths`, those relative to the recipe's folder become absolute.
std::string to_yaml(const Recipe& recipe, const Registry& registry, bool absolute_paths = false);

/// Returns the JSON Schema (draft 2020-12) of recipes, with the parameters of all registered stages.
std::string recipe_schema(const Registry& registry);

/// Returns whether the whole name matches: `*` any run of characters, `?` one character, `[a-z]` a set.
bool glob_matches(std::string_view glob, std::string_view name);

} // namespace recipe
} // namespace foam
