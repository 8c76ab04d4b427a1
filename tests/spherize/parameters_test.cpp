// Every parameter of every spherizer does something: a value other than the default gives other spheres, somewhere.
#include "all_spherizers.hpp"

#include <foam/runtime/contract.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace foam;
using namespace foam::test;

using Values = std::map<std::string, ParameterValue>;
using Case = std::pair<std::string, std::string>; // stage, parameter

std::vector<Case> all_parameters() {
    std::vector<Case> cases;
    for (const std::string& stage : spherizer_names()) {
        for (const Parameter& parameter : all_spherizers().find(stage)->info.parameters) {
            cases.emplace_back(stage, parameter.name);
        }
    }
    return cases;
}

const Parameter& declared(const std::string& stage, const std::string& name) {
    const std::vector<Parameter>& all = all_spherizers().find(stage)->info.parameters;
    return *std::find_if(all.begin(), all.end(), [&](const Parameter& p) { return p.name == name; });
}

/// Some values other than the default, within the bounds.
std::vector<ParameterValue> others(const Parameter& parameter) {
    std::vector<ParameterValue> values;
    if (const bool* flag = std::get_if<bool>(&parameter.default_value)) {
        values.push_back(!*flag);
    } else if (const auto* whole = std::get_if<std::int64_t>(&parameter.default_value)) {
        for (const double factor : {0.25, 4.0, 100.0}) {
            values.push_back(std::clamp(static_cast<std::int64_t>(std::llround(static_cast<double>(*whole) * factor)),
                                        static_cast<std::int64_t>(parameter.low.value_or(-1e9)),
                                        static_cast<std::int64_t>(parameter.high.value_or(1e9))));
        }
        values.push_back(static_cast<std::int64_t>(parameter.low.value_or(0)));
    } else if (const double* number = std::get_if<double>(&parameter.default_value)) {
        for (const double factor : {0.25, 4.0}) {
            values.push_back(std::clamp(*number * factor, parameter.low.value_or(-1e9), parameter.high.value_or(1e9)));
        }
    } else {
        for (const std::string& choice : parameter.choices) {
            values.push_back(choice);
        }
    }
    std::erase(values, parameter.default_value);
    return values;
}

/// What the others may have to be for a parameter to matter: the defaults, a deeper tree, each choice and flag turned.
std::vector<Values> bases(const std::string& stage, const std::string& parameter) {
    std::vector<Values> result{{}}, turned;
    for (const Parameter& other : all_spherizers().find(stage)->info.parameters) {
        if (other.name == parameter) {
            continue;
        }
        if (other.name == "depth") {
            result.push_back({{"depth", std::int64_t{2}}});
        }
        if (!std::holds_alternative<std::int64_t>(other.default_value) &&
            !std::holds_alternative<double>(other.default_value)) {
            for (const ParameterValue& value : others(other)) {
                turned.push_back({{other.name, value}});
            }
        }
    }
    result.insert(result.end(), turned.rbegin(), turned.rend());
    return result;
}

class SpherizerParameter : public testing::TestWithParam<Case> {
protected:
    /// Whether one of the values gives other spheres than the default for one of the budgets and solids.
    bool one_matters(Values values, const std::vector<ParameterValue>& tried) {
        const auto& [name, parameter] = GetParam();
        const auto plain = all_spherizers().make<Spherizer>(name, values);
        std::vector<std::unique_ptr<Spherizer>> changed;
        for (const ParameterValue& value : tried) {
            values[parameter] = value;
            changed.push_back(all_spherizers().make<Spherizer>(name, values));
        }
        for (const std::string solid_name : {"Bracket", "Box"}) {
            const auto solid = sample::solids().at(solid_name)();
            const Shape shape(solid_name, solid, solid);
            for (const Budget& budget : {Budget{}, Budget{9, {}, Guarantee::outer},
                                         Budget{{}, 0.1 * solid->bounds().diagonal(), Guarantee::outer}}) {
                QuietContext context;
                const SphereTree usual = plain->spherize(shape, budget, context);
                for (const auto& other : changed) {
                    if (other->spherize(shape, budget, context) != usual) {
                        return true;
                    }
                }
            }
        }
        return false;
    }
};

TEST_P(SpherizerParameter, DoesSomething) {
    const auto& [stage, parameter] = GetParam();
    for (const Values& base : bases(stage, parameter)) {
        if (one_matters(base, others(declared(stage, parameter)))) {
            SUCCEED();
            return;
        }
    }
    FAIL() << stage << ": no value of " << parameter << " that was tried changes a sphere";
}

INSTANTIATE_TEST_SUITE_P(Spherizers, SpherizerParameter, testing::ValuesIn(all_parameters()), [](const auto& test) {
    return test.param.first.substr(test.param.first.find('.') + 1) + "_" + test.param.second;
});

} // namespace
