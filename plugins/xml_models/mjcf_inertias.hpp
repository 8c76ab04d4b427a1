// The <inertial> of the bodies of an MJCF: what the robot states, made such that MuJoCo takes it.
#pragma once

#include <foam/geometry/elements.hpp>
#include <foam/geometry/volumes.hpp>
#include <foam/sdk/context.hpp>
#include <foam/sdk/model.hpp>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace foam::xml_models {

/// Makes the <inertial> of bodies, and reports which of them are not as the robot states them.
class MjcfInertias {
public:
    /// `density`: of the geometry of links without mass, kg/m³.
    MjcfInertias(const SphereModel& model, double density) : model_(model), density_(density) {}

    /// Returns the <inertial> of a link; empty for one that needs none. `elements`: of the link. `needed`: whether
    /// MuJoCo refuses the body without. Throws Error for mass properties that cannot be read.
    std::string text(const std::string& link, const Elements& elements, bool needed);
    /// Returns the mass properties that text() has written, by link.
    const std::map<std::string, MassProperties>& written() const { return written_; }
    /// Logs a warning for each way in which masses are not those that the robot states.
    void report(Context& context) const;

private:
    /// Mass properties of a link that the robot does not state, and the list of the links that have theirs from there.
    struct Invented {
        MassProperties mass;
        std::vector<std::string>* from = nullptr;
    };
    /// Returns those of the geometry, or else of the elements; nothing for a link without both.
    std::optional<Invented> invented(const std::string& link, const Elements& elements);
    std::string stated_text(const std::string& link, const Elements& elements, MassProperties mass);
    std::string accepted_text(const std::string& link, MassProperties mass);
    MassProperties of_geometry(const std::string& link, const Elements& elements, const MassProperties& stated);
    std::string with_place(const std::string& link) const;
    void report_stated(Context& context) const;
    void report_invented(Context& context) const;

    const SphereModel& model_;
    double density_;
    std::map<std::string, MassProperties> written_;
    std::vector<std::string> impossible_; ///< links whose stated inertia is not positive
    std::vector<std::string> balanced_;   ///< links one of whose stated moments is larger than the sum of the others
    std::vector<std::string> raised_;     ///< links whose mass or inertia is below what MuJoCo takes
    std::vector<std::string> light_;      ///< links that move without mass and geometry
    std::vector<std::string> from_geometry_, from_open_, from_spheres_,
        from_elements_; ///< links by what their mass is made of
};

} // namespace foam::xml_models
