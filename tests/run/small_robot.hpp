// Runs on a robot of two links, a box and a cylinder, and what they say.
#pragma once

#include "support/runs.hpp"

#include <foam/base/error.hpp>
#include <foam/base/internal/files.hpp>

#include <gmock/gmock.h>

#include <atomic>

namespace foam {

inline constexpr const char* two_links = R"(<?xml version="1.0"?>
<robot name="two">
  <!-- the base -->
  <link name="base"><collision><origin xyz="0 0 0.1"/><geometry><box size="0.4 0.2 0.2"/></geometry></collision></link>
  <link name="tip"><collision><geometry><cylinder radius="0.05" length="0.3"/></geometry></collision></link>
  <joint name="j" type="fixed"><origin xyz="0 0 0.3"/><parent link="base"/><child link="tip"/></joint>
</robot>
)";

class Run : public test::RunTest {
protected:
    Run() {
        registry.load(FOAM_TEST_MISBEHAVING);
        write("two.urdf", two_links);
    }

    /// Of the robot two.urdf; `rest`: what follows its name.
    Recipe recipe(const std::string& rest) { return recipe_of("name: two\nrobot: {urdf: two.urdf}\n" + rest); }
    std::string failure(const std::string& rest) {
        try {
            run(recipe(rest), registry, options());
        } catch (const Error& error) {
            code = error.code();
            return error.what();
        }
        return "no error";
    }

    ErrorCode code = ErrorCode::internal;
};

/// Warnings and errors of a run, in their order.
inline std::vector<std::string> warnings_of(const RunResult& result) {
    std::vector<std::string> warnings;
    for (const Finding& finding : result.findings) {
        if (finding.severity >= Severity::warning) {
            warnings.push_back(finding.link + ": " + finding.message);
        }
    }
    return warnings;
}

/// Asks the run to stop once a stage has finished so many tasks.
class StopAfter final : public Observer {
public:
    StopAfter(std::string stage, std::size_t tasks) : stage_(std::move(stage)), tasks_(tasks) {}
    void on(const Event& event) override {
        if (event.kind == Event::Kind::task_finished && event.stage == stage_ && --tasks_ == 0) {
            stop = true;
        }
    }
    std::atomic<bool> stop = false;

private:
    std::string stage_;
    std::size_t tasks_;
};

} // namespace foam
