#include "input/inputs.hpp"

#include <foam/base/text.hpp>

#include <fmt/format.h>

namespace foam::inline runtime {
namespace {

constexpr std::string_view metre = "m";

/// Returns "arm.urdf:12: box"; of a single mesh its name.
std::string name_of(const Robot& robot, const CollisionElement& element) {
    return element.source->line > 0
               ? fmt::format("{}:{}: {}", robot.file.string(), element.source->line, element.geometry)
               : element.geometry;
}

/// Returns why the geometry is not workable, first in its own frame, then in the link's frame, where it is covered;
/// empty if it is workable.
std::string why_not_workable(const CollisionElement& element, const Pose& origin, Box& in_link) {
    const Box box = bounds_of(element);
    if (std::string why = geometry::why_out_of_bounds(box); !why.empty()) {
        return why;
    }
    if (!is_finite(origin.translation) || !is_finite(origin.rotation[0]) || !is_finite(origin.rotation[1]) ||
        !is_finite(origin.rotation[2])) {
        return "its origin has a number that is not finite; remedy: correct it";
    }
    in_link.add(posed(box, origin));
    return geometry::why_bad_place(origin * (box.low * 0.5 + box.high * 0.5), geometry::size_of(box));
}

struct Complaint {
    const CollisionElement* element = nullptr; ///< null: all of them together
    std::string why;                  ///< empty: no problem
};

Complaint complaint_of(const LoadedLink& link) {
    Box whole;
    for (const CollisionElement& element : link.elements) {
        if (!element.raw && !element.primitive()) {
            return {}; // not loaded
        }
        if (std::string why = why_not_workable(element, element.source->origin, whole); !why.empty()) {
            return {&element, std::move(why)};
        }
    }
    const double size = geometry::size_of(whole);
    return {nullptr, size > geometry::largest_size
                         ? fmt::format("its collision elements are spread over {:.3g} m, more than the {:g} m up to "
                                       "which spheres can be proved to cover them; remedy: check their origins",
                                       size, geometry::largest_size)
                         : ""};
}

/// Returns the value of a parameter that is a length; 0 if it has none.
double length_of(const Parameter& declared, const Parameters& values) {
    return declared.type == Parameter::Type::number && declared.unit_text == metre ? values.number(declared.name) : 0;
}

bool keeps_bounds(const Parameter& declared, double value) {
    return value == 0 || ((!declared.low || value >= *declared.low) && (!declared.high || value <= *declared.high));
}

} // namespace

Box bounds_of(const CollisionElement& element) {
    return element.raw ? geometry::bounds_of_corners(*element.raw) : bounds(*element.primitive());
}

void require_workable(const Robot& robot, const LoadedLink& link) {
    if (const Complaint complaint = complaint_of(link); !complaint.why.empty()) {
        const std::string where = complaint.element ? name_of(robot, *complaint.element) + ": " : "";
        throw Error(ErrorCode::input, fmt::format("link '{}': {}{}", shown(link.link->name), where, complaint.why));
    }
}

bool is_workable(const LoadedLink& link) {
    return complaint_of(link).why.empty();
}

geometry::OwnFrame frame_for_stage(geometry::OwnFrame frame, const StageCall& call, const Registry& registry) {
    const RegisteredStage* stage = registry.find(call.stage);
    if (!stage || frame.exponent == 0) {
        return frame;
    }
    const Parameters values(stage->info.parameters, call.given);
    const int step = frame.exponent > 0 ? -1 : 1;
    const int wanted = frame.exponent;
    for (const Parameter& declared : stage->info.parameters) {
        const double length = length_of(declared, values);
        while (frame.exponent != 0 && !keeps_bounds(declared, std::ldexp(length, frame.exponent))) {
            frame.exponent += step;
        }
    }
    frame.dust = std::ldexp(frame.dust, frame.exponent - wanted);
    return frame;
}

StageCall call_in_frame(StageCall call, const geometry::OwnFrame& frame, const Registry& registry) {
    const RegisteredStage* stage = registry.find(call.stage);
    if (!stage || frame.exponent == 0) {
        return call;
    }
    const Parameters values(stage->info.parameters, call.given);
    for (const Parameter& declared : stage->info.parameters) {
        if (const double length = length_of(declared, values); length != 0) {
            call.given[declared.name] = std::ldexp(length, frame.exponent);
        }
    }
    return call;
}

std::vector<Budget> budgets_in_frame(std::span<const Budget> budgets, const geometry::OwnFrame& frame) {
    std::vector<Budget> result(budgets.begin(), budgets.end());
    for (Budget& budget : result) {
        if (budget.max_protrusion) {
            *budget.max_protrusion *= frame.scale();
        }
    }
    return result;
}

void FrameContext::metric(std::string_view name, double value, std::string_view unit) {
    const int power = unit == metre ? 1 : unit == "m2" || unit == "m²" ? 2 : unit == "m3" || unit == "m³" ? 3 : 0;
    context_.metric(name, value / std::pow(scale_, power), unit);
}

} // namespace foam::runtime
