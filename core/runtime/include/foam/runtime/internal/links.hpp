// The links of a robot with their spheres: searched, finished, proved as written.
#pragma once

#include <foam/geometry/internal/likeness.hpp>
#include <foam/geometry/solid.hpp>
#include <foam/runtime/internal/input.hpp>
#include <foam/sdk/model.hpp>

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] runtime {

class [[gnu::visibility("hidden")]] RandomPoses;
class [[gnu::visibility("hidden")]] ReferencePose;

/// A unit of spherization: a link, or one collision element of it.
struct Group {
    std::size_t link = 0;              ///< index into the links
    std::vector<std::size_t> elements; ///< of the link
    /// Pose of the first element's frame, in which the shape is spherized, in the link's frame. So equal geometry at
    /// different places (a pair of fingers) is one shape.
    Pose frame;
    double weight = 1;       ///< factor on its volume in the allocation
    std::size_t shape = 0;   ///< index of the distinct shape
    Likeness from_shape{};   ///< from the shape's frame to `frame`: a link may be the mirror image of another
    SphereTree tree;       ///< link frame; the spherizer's tree, transformed
    /// With spheres that the link keeps: the geometry that they leave uncovered, which `tree` is to cover, in the
    /// link's frame; null: they leave none, or there are none.
    std::shared_ptr<const Solid> uncovered;
    /// The original geometry, in the link's frame; null if it is not built yet.
    std::shared_ptr<const Solid> solid;
    /// The same with its inside, where that counts as geometry; null if it is not built yet.
    std::shared_ptr<const Solid> filled;
    /// Whether `tree` covers already, and its figures are not measured: there is no time.
    bool in_haste = false;
};

struct SpherizedLinks {
    std::vector<Group> groups;
    Cut cut = Cut::none; ///< why the search for better spheres ended early
};

/// Spherizes all links without an error, within the recipe's budget. Errors go to the links. Throws for a budget that
/// cannot be met (fewer spheres than groups), for cancellation, and for a stop before there is a model. `pose`: the
/// reference pose in which spheres of links are to stay apart; null: they need not. `poses`: those in which the
/// allocation is to avoid false contacts; null: it need not.
SpherizedLinks spherize_links(const Workspace& workspace, std::vector<LinkWork>& links, ReferencePose* pose = nullptr,
                              RandomPoses* poses = nullptr);

/// A finished link: its original geometry, in the link's frame, and its elements.
struct FinishedLink {
    const LinkWork* work = nullptr;
    std::shared_ptr<const Solid> solid;
    Elements elements; ///< of all its groups, finest level; without parents
};

struct FinishedModel {
    SphereModel model;
    std::vector<FinishedLink> links;
};

/// Returns the original geometry of some elements of a link, in the link's frame.
std::shared_ptr<const Solid> solid_of(const LoadedLink& link, const std::vector<std::size_t>& elements);
/// Returns the original geometry of all elements. Precondition: its meshes are loaded.
std::shared_ptr<const Solid> solid_of(const LoadedLink& link);

/// Returns the geometry of all elements as solid_of() does, as geometry::quick_solid(): proofs need no more.
std::shared_ptr<const Solid> quick_solid_of(const LoadedLink& link);

/// Returns about the smallest enclosing sphere of a solid, large enough that rounding its centre leaves nothing out:
/// growth, which would search for its least radius, leaves it as it is.
Sphere enclosing_ball(const Solid& solid);

/// Grows the spheres as the guarantee requires, proves it, measures them. Fills in the link reports.
FinishedModel finish_links(const Workspace& workspace, std::shared_ptr<const Robot> robot, std::vector<LinkWork>& links,
                           std::vector<Group> groups);

/// Handles links that failed: `stop` throws the first error; `skip` keeps their geometry; `fallback` gives them one
/// enclosing sphere of their vertices, if they could be loaded. Returns true if a link has no spheres as a result.
bool handle_errors(const Workspace& workspace, std::vector<LinkWork>& links, std::vector<Group>& groups);

/// The work of the proof on a written file for one link. Guarantee::inner: `pieces` and `halvings` are 0, because
/// nothing is split.
struct WrittenProof {
    std::string link;
    std::size_t spheres = 0; ///< elements of any kind
    std::size_t triangles = 0, pieces = 0;
    std::uint32_t halvings = 0; ///< of the smallest piece; 0 where elements are not all spheres
    bool float32 = false;       ///< the guarantee is also proved for the numbers rounded to single precision
};

/// Proves on the elements read back from a file, by link, what was proved in memory: the guarantee of each link whose
/// report is certified. Numbers::float32: also for these numbers rounded to single precision. Throws Error(internal)
/// for a link without elements, or with spheres alone where the model has others, and where a proof does not hold.
/// `elements_optional`: Consumer's; a link with elements of other kinds than spheres is not proved then.
std::vector<WrittenProof> prove_written(const std::map<std::string, Elements>& read,
                                        const FinishedModel& finished, Guarantee guarantee, Numbers numbers,
                                        const std::string& file, bool elements_optional = false);

} // namespace runtime
} // namespace foam
