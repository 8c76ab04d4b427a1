// The input of a run: names, places, sizes, frames.
#pragma once

#include "record/record.hpp"

#include <foam/geometry/internal/own_frame.hpp>
#include <foam/recipe/recipe.hpp>
#include <foam/runtime/internal/input.hpp>
#include <foam/sdk/context.hpp>
#include <foam/sdk/registry.hpp>

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace foam::inline runtime {

/// Returns a finding for each name of the recipe that the robot does not have: an error, but for globs a warning unless
/// the recipe is strict.
std::vector<Diagnostic> unknown_names(const Recipe& recipe, const Robot& robot);
/// Throws Error(recipe) with the errors among the findings, if there are any.
void require_names(const std::vector<Diagnostic>& findings);

/// What the files of a run's outputs state of the robot.
struct FactsForOutputs {
    RobotFacts facts;
    std::vector<std::string> said; ///< of what the recipe leaves open, for people
};
/// Returns the facts of the recipe, with the one tip of the robot as tool frame where an output needs one. Throws
/// Error(usage), naming the tips and the remedy, if there are several.
FactsForOutputs facts_for_outputs(const Workspace& workspace, const Robot& robot);

/// Returns the size of the loaded geometry, without links that are skipped or could not be read.
InputSize input_size(const Robot& robot, const std::vector<LinkWork>& links);

/// Reports the size, and warns of one that suggests another unit: an input below 1 mm or above 20 m, a length of the
/// recipe without a unit that is larger than the input.
void tell_input_size(const Workspace& workspace, const Input& input, const std::vector<LinkWork>& links,
                     const InputSize& size);

/// Warns of links whose visual geometry is larger than their collision geometry, by their boxes, and notes those that
/// have visual geometry alone. Of visual meshes those in small files count.
void tell_visual_geometry(const Workspace& workspace, const Robot& robot, const std::vector<LinkWork>& links);

struct InputsHere {
    std::vector<Checkpoint> digests; ///< as in Record::inputs
    std::map<std::string, std::filesystem::path> files;
};

/// Returns the robot or mesh file and the mesh files of its links, without those that cannot be read. Throws Error for
/// a robot that is not found or cannot be loaded.
InputsHere inputs_here(const Recipe& recipe, const Registry& registry);

/// Returns a sentence for the input, and one for each package folder, that resolves to another place here than in the
/// run, with the setting that corrects it. `here`: absent if the inputs were not found.
std::vector<std::string> inputs_elsewhere(const Record& record, const std::optional<InputsHere>& here);

/// Returns the bounds of a loaded element, in its own frame.
Box bounds_of(const CollisionElement& element);

/// Throws Error(input) with link, geometry, number and remedy if a loaded link's geometry is larger, smaller or farther
/// from the origin than foam can work on.
void require_workable(const Robot& robot, const LoadedLink& link);
/// Returns whether require_workable() passes, for a link that was loaded completely.
bool is_workable(const LoadedLink& link);

/// Returns the frame, or one closer to the given frame's scale if the stage's parameters in m would leave their bounds.
geometry::OwnFrame frame_for_stage(geometry::OwnFrame frame, const StageCall& call, const Registry& registry);
/// Returns the call with its parameters in m, defaults included, converted to lengths of the frame.
StageCall call_in_frame(StageCall call, const geometry::OwnFrame& frame, const Registry& registry);
std::vector<Budget> budgets_in_frame(std::span<const Budget> budgets, const geometry::OwnFrame& frame);

/// Passes on what a stage reports in its normalised frame: converts figures back to m, m² and m³.
class FrameContext final : public Context {
public:
    FrameContext(Context& context, const geometry::OwnFrame& frame) : context_(context), scale_(frame.scale()) {}
    std::uint64_t seed() const override { return context_.seed(); }
    bool cancelled() const override { return context_.cancelled(); }
    void progress(double fraction) override { context_.progress(fraction); }
    void log(Severity severity, std::string_view message) override { context_.log(severity, message); }
    void metric(std::string_view name, double value, std::string_view unit) override;

private:
    Context& context_;
    double scale_;
};

} // namespace foam::inline runtime
