// The kinds of experiments. A new kind is a class derived from Experiment, a function that reads it, and a line in
// kinds().
#pragma once

#include "chain.hpp"
#include "named_robot.hpp"

#include <foam/bench/experiment.hpp>

#include <cstdint>
#include <initializer_list>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

namespace foam::inline bench::experiment {

/// Reads the keys of a kind; those that all kinds share are among `shared_keys()`. What is wrong is a finding; the
/// experiment is then not used.
using KindReader = std::unique_ptr<Experiment> (*)(const reading::Value& root, const reading::Checking& checking);

struct Kind {
    const char* name;
    KindReader read;
};

std::span<const Kind> kinds();

std::unique_ptr<Experiment> read_time_against_triangles(const reading::Value& root, const reading::Checking& checking);
std::unique_ptr<Experiment> read_program_against_size(const reading::Value& root, const reading::Checking& checking);
std::unique_ptr<Experiment> read_quality_against_spheres(const reading::Value& root, const reading::Checking& checking);
std::unique_ptr<Experiment> read_collision_queries(const reading::Value& root, const reading::Checking& checking);
std::unique_ptr<Experiment> read_element_checks(const reading::Value& root, const reading::Checking& checking);
std::unique_ptr<Experiment> read_fidelity(const reading::Value& root, const reading::Checking& checking);
std::unique_ptr<Experiment> read_throughput(const reading::Value& root, const reading::Checking& checking);

/// The plain values of a kind; a finding for each key that is neither among them, nor among `structures`, nor shared.
std::map<std::string, ParameterValue> read_kind_values(const reading::Value& root,
                                                       const std::vector<Parameter>& declared,
                                                       std::initializer_list<const char*> structures,
                                                       const reading::Checking& checking);
/// Sets `target`, an integer or a double as it was declared, to the value of `key`; left alone where that was not
/// given.
template <class Number>
void take(const std::map<std::string, ParameterValue>& values, const char* key, Number& target) {
    using Declared = std::conditional_t<std::is_floating_point_v<Number>, double, std::int64_t>;
    if (const auto it = values.find(key); it != values.end()) {
        target = static_cast<Number>(std::get<Declared>(it->second));
    }
}
/// Mesh filters and the spherizer that is the last of `method`; a finding where there is none.
std::optional<Chain> read_method(const reading::Value& value, const reading::Checking& checking);
/// The list `methods`, which must be there: mesh filters and a spherizer each; a finding for each without one.
std::vector<Chain> read_methods(const reading::Value& root, const char* example, const reading::Checking& checking);
/// The value of a key that must be there; nullptr after a finding.
const reading::Value* required(const reading::Value& root, const char* key, const char* example,
                               reading::Findings& findings);
/// The map `robots`, which must be there: {NAME: FILE or [FILE, …], …}, at least one.
std::vector<NamedRobot> read_robots(const reading::Value& root, reading::Findings& findings);
/// Names of collision engines, none twice; all where there is no value.
std::vector<std::string> read_engines(const reading::Value* value, reading::Findings& findings);
/// A list of integers within the bounds, each larger than the one before it.
std::vector<std::size_t> read_counts(const reading::Value& value, const char* key, double low, double high,
                                     reading::Findings& findings);
/// The same of a key that must be there.
std::vector<std::size_t> required_counts(const reading::Value& root, const char* key, const char* example, double low,
                                         double high, reading::Findings& findings);

} // namespace foam::bench::experiment
