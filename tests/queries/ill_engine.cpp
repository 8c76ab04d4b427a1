// An engine that aborts, ends or fails where the first body is far enough from the origin. The robot named by the
// problem's engine "unmakeable" cannot be made.
#include <foam/bench/collision_engine.hpp>

#include <cstdlib>
#include <stdexcept>

namespace {

using namespace foam;

class Ill final : public CollisionEngine {
public:
    void set_obstacles(const std::vector<Obstacle>&) override {}
    void move(std::span<const Pose> poses) override { x_ = poses.front().translation.x; }
    bool hits_obstacle() override {
        if (x_ == 1) {
            std::abort();
        }
        if (x_ == 2) {
            std::_Exit(7);
        }
        return x_ > 0;
    }
    bool hits_itself(bool) override { return false; }
    double distance_to_obstacles() override { return x_; }
    double distance_to_itself() override { return 5; }

private:
    double x_ = 0;
};

} // namespace

int main() {
    return serve_engine("Ill 1", [](const std::string& name, const EngineRobot&, const std::vector<Obstacle>&) {
        if (name == "unmakeable") {
            throw std::runtime_error("no such robot");
        }
        if (name == "deadly") {
            std::abort();
        }
        return std::make_unique<Ill>();
    });
}
