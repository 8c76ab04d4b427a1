// Robots of VAMP: the sphere URDF, the SRDF and the job that cricket compiles to VAMP's code.
// Parsing: CoMMALab/cricket a2ad9d6db7 and 0a1eff2513, src/fkcc_gen.cc; output for KavrakiLab/vamp f6de6a72e0.
#pragma once

#include <foam/sdk/plugin.hpp>

namespace foam {

class VampWriter final : public Writer {
public:
    VampWriter(const Parameters& parameters, const StageMaker& maker);
    std::string write(const SphereModel& model, Context& context) const override;
    std::map<std::string, Elements> read(const std::string& bytes, const std::map<std::string, std::string>&) const override;
    std::string companion(const std::string& ending, const SphereModel& model, Context& context) const override;

private:
    std::string srdf(const SphereModel& model, Context& context) const;
    std::string job(const SphereModel& model) const;

    std::string mesh_paths_, name_, templates_, language_;
    std::int64_t resolution_;
    std::unique_ptr<Writer> srdf_; ///< write.srdf; null if no plugin has it
};

StageInfo info_of_vamp();

} // namespace foam
