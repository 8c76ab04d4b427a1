// The geometry that stages get: within bounds, in a frame in which its numbers are near 1.
#pragma once

#include <foam/geometry/internal/own_frame.hpp>
#include <foam/geometry/internal/posed_box.hpp>
#include <foam/runtime/internal/prepare.hpp>
#include <foam/sdk/context.hpp>
#include <foam/sdk/registry.hpp>

namespace foam::inline runtime {

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

} // namespace foam::runtime
