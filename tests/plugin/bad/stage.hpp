// A stage for plugins that do something else wrong.
#pragma once

#include <foam/sdk/plugin.hpp>

namespace {

class Nothing final : public foam::MeshFilter {
public:
    foam::Mesh apply(const foam::Mesh& mesh, foam::Context&) const override { return mesh; }
};

inline foam::StageInfo info(std::string name, std::vector<foam::Parameter> parameters = {}) {
    foam::StageInfo info;
    info.name = std::move(name);
    info.summary = "For tests.";
    info.parameters = std::move(parameters);
    return info;
}

} // namespace
