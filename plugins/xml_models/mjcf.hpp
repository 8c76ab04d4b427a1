// MJCF, the format of MuJoCo: a body for each link, its spheres as geoms, its joint and inertia, pairs as <exclude>.
#pragma once

#include <foam/sdk/elements.hpp>
#include <foam/sdk/stage.hpp>
#include <foam/sdk/writing.hpp>

namespace foam::xml_models {

class MjcfWriter final : public Writer {
public:
    explicit MjcfWriter(const Parameters& parameters);
    std::string write(const SphereModel& model, Context& context) const override;
    std::map<std::string, Elements>
    read(const std::string& bytes, const std::map<std::string, std::string>& beside) const override;

private:
    KnownKinds known_;
    bool free_;
    double density_;          ///< kg/m³
    bool replaces_collision_; ///< in a file of the user
    PairEdit pairs_;          ///< in a file of the user
};

class MjcfReader final : public ModelReader {
public:
    bool recognises(std::string_view text) const override;
    SphereFile read(const std::string& text, const std::filesystem::path& file, Context& context) const override;
};

} // namespace foam::xml_models
