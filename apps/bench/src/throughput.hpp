// The experiment of kind throughput: read in throughput_reading.cpp, told in throughput_tables.cpp.
#pragma once

#include "bench.hpp"
#include "chain.hpp"
#include "grasp_scene.hpp"
#include "named_robot.hpp"

#include <foam/judge/evaluate.hpp>

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace foam::inline bench::experiment {

/// Values of joints at a time; those that are not named stay where they were.
struct Moment {
    double time = 0; ///< s
    JointValues joints;
};

/// The robot with one kind of geometry.
struct GraspModel {
    std::string label;
    std::vector<GraspLink> links;
    std::size_t spheres = 0; ///< 0: the original
    GraspScene scene;
};

/// One run of all simulations of a model.
struct Measurement {
    double steps = 0, wall = 0, cpu = 0; ///< s
    double contacts = 0;                 ///< a step
    std::size_t gripped = 0, lifted = 0; ///< simulations
    double lift = 0;                     ///< m; mean
};

class Throughput final : public Experiment {
public:
    NamedRobot robot;
    std::optional<Chain> method;
    std::vector<std::size_t> spheres; ///< budgets over the whole robot
    std::size_t simulations = 300, repeats = 5, threads = 0;
    double timestep = 0.004, spread = 0.003, lift = 0.05;
    GraspObject object;
    std::vector<std::string> fingers, object_ignores;
    std::vector<Moment> motion;

    std::set<std::string> stages() const override;
    Outcome run(Bench& bench) const override;

private:
    std::vector<GraspModel> models_of(const Bench& bench, const Original& original) const;
    /// The pairs that the self-collision matrix of any of the sphere models leaves out: the same for all models.
    LinkPairs excluded_pairs(const Kinematics& kinematics, const std::vector<GraspModel>& models,
                             const Bench& bench) const;
    /// What the program is asked.
    nlohmann::json request_of(const Kinematics& kinematics, const GraspScene& scene) const;
    std::size_t threads_used() const;
    Measurement measured(const Bench& bench, const std::filesystem::path& program, const Kinematics& kinematics,
                         const GraspModel& model, std::string& version) const;
    Measurement measurement_of(const nlohmann::json& answer, const GraspModel& model) const;
    Outcome told(const std::vector<GraspModel>& models, const std::vector<std::vector<Measurement>>& results,
                 const std::string& version, const std::string& input, std::size_t excluded) const;
    std::string text_of(const std::string& version, const std::string& input, std::size_t excluded) const;
};

} // namespace foam::bench::experiment
