// The share of a run that is done, as observers see it.
#include "small_robot.hpp"

namespace foam {
namespace {

class Shares final : public Observer {
public:
    void on(const Event& event) override { events.push_back(event); }
    std::vector<Event> events;
};

class Progress : public Run {
protected:
    void watch_a_run_with_pictures() {
        RunOptions o = options();
        o.observer = &shares;
        run(recipe("stages: [spherize.grid]\nbudget: {spheres: 60}\nsnapshots: true\n"), registry, o);
    }

    Shares shares;
};

TEST_F(Progress, NothingIsWholeBeforeTheEnd) {
    if (!registry.find("snapshot.osmesa")) {
        GTEST_SKIP() << "no renderer is built";
    }
    watch_a_run_with_pictures();
    ASSERT_FALSE(shares.events.empty());
    double before = 0;
    for (const Event& event : shares.events) {
        EXPECT_GE(event.done, before) << "it never goes back";
        before = event.done;
        if (event.kind != Event::Kind::run_finished) {
            EXPECT_LT(event.done, 1);
        }
    }
    EXPECT_EQ(shares.events.back().kind, Event::Kind::run_finished);
    EXPECT_EQ(shares.events.back().done, 1);
}

/// The search has no known end, and pictures are a good part of the whole.
TEST_F(Progress, PhasesHaveTheirShares) {
    if (!registry.find("snapshot.osmesa")) {
        GTEST_SKIP() << "no renderer is built";
    }
    watch_a_run_with_pictures();
    double searched = 0, measured = 0, pictured = 2;
    for (const Event& event : shares.events) {
        if (event.kind == Event::Kind::task_finished && event.stage == "spherize.grid") {
            searched = std::max(searched, event.done);
            EXPECT_FALSE(event.seconds_left) << "nobody knows";
        } else if (event.kind == Event::Kind::task_finished && event.stage == "measure") {
            measured = std::max(measured, event.done);
        } else if (event.kind == Event::Kind::task_started && event.stage.starts_with("snapshot.")) {
            pictured = std::min(pictured, event.done);
        }
    }
    EXPECT_LT(searched, 0.62);
    EXPECT_LT(measured, 0.8);
    EXPECT_GT(measured, searched);
    EXPECT_LT(pictured, 0.8);
}

} // namespace
} // namespace foam
