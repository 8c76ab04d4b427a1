// Parameters of stages in the frame in which they work.
#include "runtime/src/input/inputs.hpp"
#include "support/runs.hpp"

namespace foam {
namespace {

StageCall call(const std::string& stage, const std::map<std::string, ParameterValue>& given = {}) {
    StageCall result;
    result.stage = stage;
    result.given = given;
    return result;
}

using FrameOfStages = test::RunTest;

TEST_F(FrameOfStages, LengthsOfStagesStayMetres) {
    const geometry::OwnFrame larger{{}, 3, 0}, far_larger{{}, 60, 0};
    const StageCall voxel =
        call_in_frame(call("spherize.voxel", {{"radius", 0.5}, {"spacing", 1.5}}), larger, registry);
    EXPECT_EQ(std::get<double>(voxel.given.at("radius")), 4);
    EXPECT_EQ(std::get<double>(voxel.given.at("spacing")), 1.5);
    EXPECT_EQ(std::get<double>(call_in_frame(call("spherize.voxel"), larger, registry).given.at("radius")), 0.16);
    // At most 1000 m: the frame is one in which that is so.
    EXPECT_EQ(frame_for_stage(far_larger, call("spherize.voxel", {{"radius", 0.5}}), registry).exponent, 10);
    EXPECT_EQ(frame_for_stage(far_larger, call("spherize.octree"), registry), far_larger);
}

} // namespace
} // namespace foam
