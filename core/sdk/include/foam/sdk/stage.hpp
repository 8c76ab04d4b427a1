// The kinds of stages. A stage object is const after construction, and many threads use it at once. Its only access to
// the outside is the Context of the call. Stages throw foam::Error for what the user should know.
#pragma once

#include <foam/geometry/clip_plane.hpp>
#include <foam/geometry/figure.hpp>
#include <foam/geometry/mesh.hpp>
#include <foam/geometry/objective.hpp>
#include <foam/geometry/solid.hpp>
#include <foam/geometry/sphere.hpp>
#include <foam/robot/robot.hpp>
#include <foam/sdk/context.hpp>
#include <foam/sdk/model.hpp>
#include <foam/sdk/parameter.hpp>
#include <foam/sdk/resource.hpp>

#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] sdk {

enum class StageKind { mesh_loader, robot_loader, mesh_filter, spherizer, renderer, writer, model_reader, refiner };
const char* to_string(StageKind kind);

/// Base of all stages.
class Stage {
public:
    virtual ~Stage();
    Stage(const Stage&) = delete;
    Stage& operator=(const Stage&) = delete;

protected:
    Stage();
};

/// File → mesh. StageInfo::extensions lists the file types.
class MeshLoader : public Stage {
public:
    static constexpr StageKind kind = StageKind::mesh_loader;
    ~MeshLoader() override;
    /// Returns the mesh in metres where the format has units, otherwise in file units. Node transforms are applied; the
    /// up-axis is ignored, as in ROS. Vertices are finite, indices in range, and there is at least one triangle. Throws
    /// Error(input) naming file, place and reason.
    virtual Mesh load(const std::filesystem::path& file, Context& context) const = 0;
};

/// File → robot.
class RobotLoader : public Stage {
public:
    static constexpr StageKind kind = StageKind::robot_loader;
    ~RobotLoader() override;
    /// Returns whether the text is a file of this format, judged by its root element. Never throws.
    virtual bool recognises(std::string_view text) const = 0;
    /// Returns the robot. `text`: the contents of `file` (which need not exist: relative references start at its
    /// folder). All mesh references of collision elements are resolved. Throws Error(input) with file:line for what
    /// cannot be read or found.
    virtual Robot load(const std::string& text, const std::filesystem::path& file, const ResourceResolver& resources,
                       Context& context) const = 0;
};

/// Mesh → mesh: repair.*, simplify.*, smooth.*.
class MeshFilter : public Stage {
public:
    static constexpr StageKind kind = StageKind::mesh_filter;
    ~MeshFilter() override;
    virtual Mesh apply(const Mesh& mesh, Context& context) const = 0;
};

/// What a check of an element costs in a consumer, by kind, relative to each other.
struct ElementCost {
    static constexpr auto usual = std::to_array<double>({1, 2, 4, 4, 6, 0, 8});
    static_assert(usual.size() == element_kinds);
    std::array<double, element_kinds> of_kind = usual; ///< by Element::Kind
    double of_hull_vertex = 0.1;                       ///< added for each vertex of a hull

    bool operator==(const ElementCost&) const = default;
};

/// The number of elements, and what they must achieve.
struct Budget {
    std::optional<std::size_t> max_spheres; ///< elements of any kind, at least 1; absent: the stage's parameters decide
    std::optional<double> max_protrusion;   ///< m; a goal, as far as max_spheres allows
    Guarantee guarantee = Guarantee::outer;
    /// The most that the elements may cost together; a single element may cost more. Absent: only their number counts.
    std::optional<double> max_cost{};
    ElementCost cost{};
};

/// The search for spheres of one shape. It may keep data between calls, to continue from its own results. One call at a
/// time; context.seed() is the same in all calls.
class SphereSearch {
public:
    virtual ~SphereSearch();
    SphereSearch(const SphereSearch&) = delete;
    SphereSearch& operator=(const SphereSearch&) = delete;
    /// Returns one tree for each budget, as Spherizer::spherize() does, whatever the calls before. After an exception
    /// the search is not used again.
    virtual std::vector<SphereTree> at_most(std::span<const Budget> budgets, Context& context) = 0;

protected:
    SphereSearch();
};

/// Solid → spheres, or other convex elements: spherize.*, approximate.*. StageInfo::kinds has the kinds of elements.
class Spherizer : public Stage {
public:
    static constexpr StageKind kind = StageKind::spherizer;
    ~Spherizer() override;
    /// Returns spheres that approximate the shape: at least one, at most budget.max_spheres in the finest level. They
    /// should cover shape.original() when the guarantee is outer; the runtime proves it and grows spheres that fall
    /// short.
    virtual SphereTree spherize(const Shape& shape, const Budget& budget, Context& context) const = 0;
    /// Starts the search for a shape; stage and shape must outlive it. Override it where several budgets can share
    /// work; the default calls spherize() for each.
    virtual std::unique_ptr<SphereSearch> search(const Shape& shape) const;
};

/// What a refinement has to keep, and what it may change.
struct RefinementGoal {
    Guarantee guarantee = Guarantee::outer;
    /// The objective of the spherizer; nothing: foam does not know it, so that no other spheres may replace its
    /// spheres.
    std::optional<Objective> objective = Objective::excess;
    std::optional<double> max_protrusion; ///< m
    std::vector<ClipPlane> clip;          ///< half-space constraints in the shape's frame
};

/// The refinement of the spheres of one shape. It may keep data between calls, to continue from its own results. Many
/// threads may call it at once; of refiners that add spheres the runtime makes one call after the other, in an order
/// that does not depend on threads.
class Refinement {
public:
    virtual ~Refinement();
    Refinement(const Refinement&) = delete;
    Refinement& operator=(const Refinement&) = delete;
    /// Returns the tree itself, or one that keeps the goal better, with at most `most` spheres in the finest level. If
    /// context.cancelled() becomes true it returns its best result so far.
    virtual SphereTree refine(SphereTree tree, std::size_t most, Context& context) = 0;

protected:
    Refinement();
};

/// Spheres → better spheres, whatever spherizer they are from: refine.*.
class Refiner : public Stage {
public:
    static constexpr StageKind kind = StageKind::refiner;
    ~Refiner() override;
    /// Starts the refinement of a shape, which must outlive it.
    virtual std::unique_ptr<Refinement> begin(const Shape& shape, const RefinementGoal& goal) const = 0;
};

/// Figure → picture.
class Renderer : public Stage {
public:
    static constexpr StageKind kind = StageKind::renderer;
    ~Renderer() override;
    virtual Image render(const Figure& figure, Context& context) const = 0;
};

/// Model → file.
class Writer : public Stage {
public:
    static constexpr StageKind kind = StageKind::writer;
    ~Writer() override;
    /// Returns the bytes of the file. Equal models give equal bytes.
    virtual std::string write(const SphereModel& model, Context& context) const = 0;
    /// Returns the elements (finest level) by link, read back from such bytes and from the files beside them, exactly as another
    /// program would read them. The runtime proves the guarantee on these. `beside`: the texts of the files that files_beside()
    /// returned, by name. Throws Error(output) if the bytes cannot be read.
    virtual std::map<std::string, Elements> read(const std::string& bytes,
                                                 const std::map<std::string, std::string>& beside = {}) const = 0;
    /// Returns the bytes of a file that belongs to that of write(): one for each ending of StageInfo::companions.
    /// Throws Error(internal) unless overridden.
    virtual std::string companion(const std::string& ending, const SphereModel& model, Context& context) const;
    /// Returns the files that the written file refers to, by their names relative to its folder: meshes of hulls. The
    /// default returns none.
    virtual std::map<std::string, std::string> files_beside(const SphereModel& model, Context& context) const;
};

/// Returns the name of a companion of `file`: "arm.srdf" of "arm.urdf" for "srdf".
std::filesystem::path companion_of(const std::filesystem::path& file, const std::string& ending);

/// Sphere model in a file of any program → spheres by link. The content of the file determines the reader.
class ModelReader : public Stage {
public:
    static constexpr StageKind kind = StageKind::model_reader;
    ~ModelReader() override;
    /// Returns whether the text is a file of this format, judged by its beginning and its keys. It begins with the
    /// first character that is neither blank nor in a line that starts with '#'. Never throws; time linear in the size
    /// of the text.
    virtual bool recognises(std::string_view text) const = 0;
    /// Returns the spheres; those that the format switches off keep their radius of at most 0. `text`: the contents of
    /// `file` (which need not exist: relative references start at its folder). Throws Error(input) naming file, place
    /// and reason.
    virtual SphereFile read(const std::string& text, const std::filesystem::path& file, Context& context) const = 0;
};

/// Returns what `writer` reads back from the text, as the result of a ModelReader for its format. `remedy`: for a file
/// that cannot be read. Throws Error(input) naming the file.
SphereFile read_written(const Writer& writer, const std::string& text, const std::filesystem::path& file,
                        std::string format, std::string_view remedy);

/// Whether the calls of a stage run in child processes, and the limits of these. Absent values are inherited: first
/// from the stage's key in a recipe, then from the top level, then from StageInfo::isolation.
struct Isolation {
    std::optional<bool> process{};
    std::optional<double> time_limit{};        ///< s; of one call
    std::optional<std::size_t> memory_limit{}; ///< MiB; of one call

    bool operator==(const Isolation&) const = default;
    /// Returns these values, with absent ones taken from `base`.
    Isolation over(const Isolation& base) const;
};

/// The program that reads what a writer writes.
struct Consumer {
    std::string name{};   ///< and the version that its parser was checked in: "cuRobo 0.8 (a35a708ecf)"
    bool float32 = false; ///< it holds single precision: the proof is also made on these numbers
    bool pairs = false;   ///< its files list the pairs of links that need no check: SphereModel::ignored_pairs
    /// Elements are an extra in its files, which the program does not need: a model with elements of other kinds than
    /// StageInfo::kinds is written without these.
    bool elements_optional = false;
    std::string pairs_if{}; ///< the boolean parameter without which the files do not list them; empty: always
    /// Its files have a rest pose, or place the links in one: RobotFacts::default_pose.
    bool rest_pose = false;
    bool edits = false; ///< the writer can replace the spheres of a file: SphereModel::into
    bool tool_frames = false; ///< its files name the links that a planner moves to a goal: RobotFacts::tool_frames
};

struct StageInfo;
/// Returns whether a writer lists the pairs of links that need no check, with these parameters. `into`: in a file of
/// the user, which keeps its own pairs unless pair_edit() says otherwise.
bool lists_pairs(const StageInfo& writer, const std::map<std::string, ParameterValue>& given, bool into);

/// A plugin's description of a stage.
struct StageInfo {
    std::string name{};      ///< "kind.method", e.g. "repair.watertight"
    std::string summary{};   ///< one sentence
    std::string reference{}; ///< the paper or document the method follows; may be empty
    int revision = 1;        ///< raise it when the same input gives another output: old cache entries are then ignored
    std::vector<Parameter> parameters{};
    std::vector<std::string> extensions{}; ///< loaders and writers: file name endings, lower case, no dot
    /// Stages of other plugins that this one uses if they are present: see StageMaker. Their versions count as part of
    /// this one's.
    std::vector<std::string> uses{};
    /// Spherizers: whether they use only Shape::original(), so that mesh filters before them change nothing.
    bool original_only = false;
    /// Spherizers: the parameter, a choice, that selects the objective: "excess", "protrusion" or "radius" (the
    /// largest). The runtime compares the stage's results, and allocates spheres over links, by that objective. With
    /// any other word, only the stage knows its objective, and the runtime accepts its spheres as they are. Empty:
    /// excess.
    std::string objective_parameter{};
    /// Refiners: whether they add spheres where there are fewer than allowed. The runtime calls them for links with a
    /// fixed count, between the counts that it asks the spherizer for, so that a larger budget never gives a worse
    /// result. Where spheres are allocated over links, it does not call them: fewer spheres leave more to other links.
    bool adds_spheres = false;
    /// Mesh loaders: those of `extensions` whose files state their unit, so that load() returns metres.
    std::vector<std::string> extensions_with_unit{};
    /// Mesh loaders, mesh filters and spherizers: the isolation unless a recipe overrides it.
    Isolation isolation{};
    /// Spherizers: the kinds of elements that they return. Writers: those that their files hold; the runtime refuses a
    /// model with others.
    std::vector<Element::Kind> kinds{Element::Kind::sphere};
    /// Loaders: whether other loaders of the same file name ending have precedence.
    bool last_resort = false;
    Consumer consumer{}; ///< writers of other programs' formats
    /// Writers: endings of the files that belong to the one that is written, beside it under the same name.
    std::vector<std::string> companions{};
};

} // namespace sdk
} // namespace foam
