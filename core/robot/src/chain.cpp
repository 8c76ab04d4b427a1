#include <foam/robot/internal/chain.hpp>

#include <algorithm>

namespace foam::inline robot::joint_chain {
namespace {

/// Returns the links from `link` up to the root.
std::vector<std::size_t> way_up(const Kinematics& kinematics, std::size_t link) {
    std::vector<std::size_t> way{link};
    while (const auto joint = kinematics.joint_above()[way.back()]) {
        way.push_back(kinematics.link_above()[*joint]);
    }
    return way;
}

double value_of(const Step& step, std::span<const double> configuration) {
    const JointMotion& motion = step.motion;
    return step.sign * (motion.multiplier * configuration[*motion.freedom] + motion.offset);
}

/// Appends steps to a chain. Merges fixed transforms into the chain's end.
class Walker {
public:
    explicit Walker(const Kinematics& kinematics) : kinematics_(kinematics) {}

    void up(std::size_t index) {
        const Joint& joint = kinematics_.robot().joints[index];
        move(joint, index, -1);
        chain.end = chain.end * joint.origin.inverse();
    }
    void down(std::size_t index) {
        const Joint& joint = kinematics_.robot().joints[index];
        chain.end = chain.end * joint.origin;
        move(joint, index, 1);
    }

    Chain chain;

private:
    void move(const Joint& joint, std::size_t index, double sign) {
        chain.unbounded = chain.unbounded || joint.kind == Joint::Kind::planar || joint.kind == Joint::Kind::floating;
        const JointMotion& motion = kinematics_.motions()[index];
        if (motion.freedom) {
            chain.steps.push_back({chain.end, &joint, sign, motion});
            chain.end = {};
        } else {
            chain.end = chain.end * joint_motion(joint, sign * motion.offset);
        }
    }

    const Kinematics& kinematics_;
};

/// Returns the chain from its end to its start.
Chain reversed(const Chain& chain) {
    Chain result;
    result.unbounded = chain.unbounded;
    Pose before = chain.end.inverse();
    for (std::size_t i = chain.steps.size(); i-- > 0;) {
        const Step& step = chain.steps[i];
        result.steps.push_back({before, step.joint, -step.sign, step.motion});
        before = step.before.inverse();
    }
    result.end = before;
    return result;
}

} // namespace

Way way_between(const Kinematics& kinematics, std::size_t from, std::size_t to) {
    Way way{way_up(kinematics, from), way_up(kinematics, to)};
    while (!way.up.empty() && !way.down.empty() && way.up.back() == way.down.back()) {
        way.meeting = way.up.back();
        way.up.pop_back();
        way.down.pop_back();
    }
    std::reverse(way.down.begin(), way.down.end());
    return way;
}

Chain chain_between(const Kinematics& kinematics, std::size_t from, std::size_t to) {
    const Way way = way_between(kinematics, from, to);
    Walker walker(kinematics);
    for (const std::size_t link : way.up) {
        walker.up(*kinematics.joint_above()[link]);
    }
    for (const std::size_t link : way.down) {
        walker.down(*kinematics.joint_above()[link]);
    }
    return std::move(walker.chain);
}

Pose forward(const Chain& chain, std::span<const double> configuration, std::span<Axis> axes) {
    Pose pose;
    for (std::size_t i = 0; i < chain.steps.size(); ++i) {
        const Step& step = chain.steps[i];
        pose = pose * step.before;
        axes[i] = {pose.translation, pose.rotate(step.joint->axis)};
        pose = pose * joint_motion(*step.joint, value_of(step, configuration));
    }
    return pose * chain.end;
}

SplitChain split(const Chain& chain, std::size_t cut) {
    const auto middle = chain.steps.begin() + static_cast<std::ptrdiff_t>(cut);
    Chain head;
    head.steps.assign(chain.steps.begin(), middle);
    Chain tail;
    tail.steps.assign(middle, chain.steps.end());
    tail.end = chain.end;
    return {reversed(head), tail};
}

bool adjacent(const Kinematics& kinematics, const std::vector<bool>& has_geometry, std::size_t first,
              std::size_t second) {
    const Way way = way_between(kinematics, first, second);
    std::vector<std::size_t> links = way.up;
    links.insert(links.end(), way.down.begin(), way.down.end());
    const auto movable = std::count_if(links.begin(), links.end(), [&](std::size_t link) {
        return kinematics.robot().joints[*kinematics.joint_above()[link]].kind != Joint::Kind::fixed;
    });
    links.push_back(way.meeting);
    return movable <= 1 && std::all_of(links.begin(), links.end(), [&](std::size_t link) {
               return link == first || link == second || !has_geometry[link];
           });
}

} // namespace foam::robot::joint_chain
