// SRDF: pairs of links, and spheres of links as a side-car (srdfdom's link_sphere_approximation).
#pragma once

#include <foam/sdk/stage.hpp>
#include <foam/sdk/writing.hpp>

namespace foam::xml_models {

class SrdfWriter final : public Writer {
public:
    explicit SrdfWriter(const Parameters& parameters);
    std::string write(const SphereModel& model, Context& context) const override;
    std::map<std::string, Elements> read(const std::string& bytes, const std::map<std::string, std::string>&) const override;

private:
    PairEdit pairs_; ///< in a file of the user
};

class SrdfReader final : public ModelReader {
public:
    bool recognises(std::string_view text) const override;
    SphereFile read(const std::string& text, const std::filesystem::path& file, Context& context) const override;
};

} // namespace foam::xml_models
