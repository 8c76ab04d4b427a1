// What stages get: geometry within bounds, in a frame in which its numbers are near 1.
#pragma once

#include "prepare.hpp"

#include "geometry/own_frame.hpp"

#include <foam/context.hpp>
#include <foam/host/registry.hpp>

namespace foam {

/// Of an element that was loaded, in its own frame.
Box bounds_of(const Element& element);
/// A box that holds the box at the pose.
Box posed(const Box& box, const Pose& pose);

/// Throws Error(input) naming link, geometry, number and remedy where the geometry of a link that was loaded is larger,
/// smaller or farther away than can be worked on.
void require_workable(const Robot& robot, const LinkWork& link);
/// Whether that is so, of a link of which all could be loaded.
bool is_workable(const LinkWork& link);

/// The frame, or one nearer to the given frame's scale if the stage's parameters in m would leave their bounds.
geometry::OwnFrame frame_for_stage(geometry::OwnFrame frame, const StageCall& call, const Registry& registry);
/// The call with its parameters in m, defaults too, in lengths of the frame.
StageCall call_in_frame(StageCall call, const geometry::OwnFrame& frame, const Registry& registry);
std::vector<Budget> budgets_in_frame(std::span<const Budget> budgets, const geometry::OwnFrame& frame);

/// Hands on what a stage says in a frame of its own: figures in m, m² and m³ in those units again.
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

} // namespace foam
