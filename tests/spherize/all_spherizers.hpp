// Every spherizer that was built, for tests of what they all promise.
#pragma once

#include <foam/sdk/registry.hpp>

#include <algorithm>
#include <string>
#include <vector>

namespace foam::test {

inline const Registry& all_spherizers() {
    static const Registry& registry = []() -> const Registry& {
        static Registry made;
        for (const auto& entry : std::filesystem::directory_iterator(FOAM_TEST_PLUGINS)) {
            if (entry.path().filename().string().starts_with("spherize_")) {
                made.load(entry.path());
            }
        }
        return made;
    }();
    return registry;
}

inline bool has_parameter(const RegisteredStage& stage, const std::string& name) {
    return std::any_of(stage.info.parameters.begin(), stage.info.parameters.end(),
                       [&](const Parameter& parameter) { return parameter.name == name; });
}

/// The names of all spherizers, or of those that have a parameter.
inline std::vector<std::string> spherizer_names(const std::string& parameter = "") {
    std::vector<std::string> names;
    for (const auto& [name, stage] : all_spherizers().stages()) {
        if (stage.kind == StageKind::spherizer && (parameter.empty() || has_parameter(stage, parameter))) {
            names.push_back(name);
        }
    }
    return names;
}

} // namespace foam::test
