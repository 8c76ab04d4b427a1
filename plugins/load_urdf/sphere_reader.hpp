// read.urdf: the spheres of a URDF's collision elements.
#pragma once

#include <foam/sdk/plugin.hpp>

namespace foam::urdf {

class SphereReader final : public ModelReader {
public:
    SphereReader(const Parameters& parameters, const StageMaker& maker);
    bool recognises(std::string_view text) const override;
    SphereFile read(const std::string& text, const std::filesystem::path& file, Context& context) const override;

private:
    std::unique_ptr<RobotLoader> loader_;
};

} // namespace foam::urdf
