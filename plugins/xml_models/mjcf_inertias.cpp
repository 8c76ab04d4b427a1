// What MuJoCo refuses: doc/modeling.rst (inertia), and user_objects.cc of 2.2.2 and 3.14.
#include "mjcf_inertias.hpp"

#include "mjcf.hpp"

#include <foam/base/error.hpp>
#include <foam/base/text.hpp>
#include <foam/geometry/element_forms.hpp>
#include <foam/geometry/vector.hpp>

#include <fmt/format.h>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace foam::xml_models {
namespace {

/// Returns the mass properties that a robot states, in the link's frame: fullinertia of MJCF allows no orientation.
MassProperties stated_mass(const Inertial& inertial, const Robot& robot, const std::string& link) {
    if (!inertial.problem.empty()) {
        throw Error(ErrorCode::input, inertial.problem);
    }
    if (!inertial.mass || !inertial.moments) {
        throw Error(ErrorCode::output,
                    fmt::format("{}: <inertial> needs <mass> and <inertia> for MuJoCo",
                                inertial.line > 0 ? fmt::format("{}:{}", robot.file.string(), inertial.line)
                                                  : fmt::format("link '{}'", shown(link))));
    }
    const auto& [xx, yy, zz, xy, xz, yz] = *inertial.moments;
    const Vec3 rows[3] = {{xx, xy, xz}, {xy, yy, yz}, {xz, yz, zz}};
    const auto turned = [&](std::size_t i, std::size_t j) { // (R I Rᵀ)ᵢⱼ
        const Vec3& a = inertial.origin.rotation[i];
        const Vec3& b = inertial.origin.rotation[j];
        return dot(a, {dot(rows[0], b), dot(rows[1], b), dot(rows[2], b)});
    };
    return {.mass = *inertial.mass,
            .center = inertial.origin.translation,
            .inertia = {turned(0, 0), turned(1, 1), turned(2, 2), turned(0, 1), turned(0, 2), turned(1, 2)}};
}

/// Least mass and least moment of inertia that are written, in kg and kg m²: MuJoCo refuses those below mjEPS, 1e-14,
/// and rounds in between.
constexpr double least_inertia = 2e-14;
/// By how much the two lesser moments may fall short of the largest, as a part of it, where numbers are rounded.
constexpr double rounded_numbers = 1e-9;
/// By how much they must exceed it: MuJoCo computes the moments anew, and allows no error.
constexpr double least_surplus = 1e-14;

/// Returns the principal moments of inertia, ascending.
Eigen::Vector3d principal_moments(const MassProperties& mass) {
    const auto& [xx, yy, zz, xy, xz, yz] = mass.inertia;
    Eigen::Matrix3d inertia;
    inertia << xx, xy, xz, xy, yy, yz, xz, yz, zz;
    return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(inertia, Eigen::EigenvaluesOnly).eigenvalues();
}

/// Returns whether the mass and all moments are positive.
bool is_positive(const MassProperties& mass) {
    constexpr double rounding = 1e-14; // of the largest moment
    const Eigen::Vector3d moments = principal_moments(mass);
    return mass.mass > 0 && moments[0] > rounding * moments[2];
}

/// Returns by how much the two lesser moments exceed the largest, as a part of it: negative for what no body has.
double surplus(const MassProperties& mass) {
    const Eigen::Vector3d moments = principal_moments(mass);
    return (moments[0] + moments[1] - moments[2]) / moments[2];
}

void add_to_moments(MassProperties& mass, double moment) {
    for (std::size_t i = 0; i < 3; ++i) { // xx yy zz
        mass.inertia[i] += moment;
    }
}

/// Gives all axes the mean of the principal moments, as balanceinertia of MuJoCo does.
void balance(MassProperties& mass) {
    const double mean = (mass.inertia[0] + mass.inertia[1] + mass.inertia[2]) / 3;
    mass.inertia = {mean, mean, mean, 0, 0, 0};
}

/// Raises all moments by the same where the sum of two differs from the third by rounding, as for a plate.
void raise_above_rounding(MassProperties& mass) {
    if (const double sum = surplus(mass); sum < least_surplus) {
        add_to_moments(mass, (2 * least_surplus - sum) * principal_moments(mass)[2]);
    }
}

/// Raises a mass that MuJoCo refuses, and all moments by the same, so that they stay those of a body. Returns whether
/// it did.
bool raise_to_least(MassProperties& mass) {
    const double missing = least_inertia - principal_moments(mass)[0];
    if (mass.mass >= least_inertia && missing <= 0) {
        return false;
    }
    mass.mass = std::max(mass.mass, least_inertia);
    add_to_moments(mass, std::max(missing, 0.0));
    return true;
}

/// Returns the mass properties of the spheres: the volume of their union, spread like their volumes.
MassProperties of_spheres(const std::vector<Sphere>& spheres, double density) {
    double total = 0;
    MassProperties result;
    for (const Sphere& s : spheres) {
        const double weight = s.radius * s.radius * s.radius;
        total += weight;
        result.center += s.center * weight;
    }
    result.center = result.center / total;
    result.mass = density * exact_union_volume(spheres);
    auto& [xx, yy, zz, xy, xz, yz] = result.inertia;
    for (const Sphere& s : spheres) {
        const double part = result.mass * s.radius * s.radius * s.radius / total, own = 0.4 * s.radius * s.radius;
        const Vec3 d = s.center - result.center;
        xx += part * (own + d.y * d.y + d.z * d.z);
        yy += part * (own + d.x * d.x + d.z * d.z);
        zz += part * (own + d.x * d.x + d.y * d.y);
        xy -= part * d.x * d.y;
        xz -= part * d.x * d.z;
        yz -= part * d.y * d.z;
    }
    return result;
}

/// Returns the mass properties of the union of the elements.
std::optional<MassProperties> of_elements(const Elements& elements, double density) {
    std::vector<Solid::Part> parts;
    for (const Sphere& s : elements.spheres()) {
        parts.push_back({nullptr, Element::sphere(s.radius), Pose{.translation = s.center}});
    }
    for (const Element& element : elements.shaped()) {
        parts.push_back({std::make_shared<const Mesh>(enclosing_mesh(element)), std::nullopt, Pose{}});
    }
    return mass_properties(*Solid::make(std::move(parts)), density);
}

/// Returns the mass properties of a ball of water.
MassProperties of_ball(double mass, const Vec3& center) {
    const double radius = std::cbrt(3 * mass / (4 * std::numbers::pi * 1000));
    const double moment = 0.4 * mass * radius * radius;
    return {.mass = mass, .center = center, .inertia = {moment, moment, moment, 0, 0, 0}};
}

} // namespace

std::string MjcfInertias::text(const std::string& link, const Elements& elements, bool needed) {
    // The elements have no mass, as their overlaps would count twice: so every body that moves needs an <inertial>.
    constexpr double light = 1e-6; // kg: nothing beside a link, and far above what MuJoCo refuses
    const std::optional<Inertial>& inertial = model_.robot->find_link(link)->inertial;
    const auto stated = inertial ? std::optional(stated_mass(*inertial, *model_.robot, link)) : std::nullopt;
    if (stated && stated->mass > 0) {
        return stated_text(link, elements, *stated);
    }
    if (stated && !needed) {
        return ""; // a body of the world needs no mass
    }
    if (const auto other = invented(link, elements)) {
        other->from->push_back(link);
        return accepted_text(link, other->mass);
    }
    if (!needed) {
        return "";
    }
    light_.push_back(link);
    return accepted_text(link, of_ball(light, {}));
}

std::string MjcfInertias::stated_text(const std::string& link, const Elements& elements, MassProperties mass) {
    if (!is_positive(mass)) {
        impossible_.push_back(with_place(link));
        mass = of_geometry(link, elements, mass);
    } else if (surplus(mass) < -rounded_numbers) {
        balanced_.push_back(with_place(link));
        balance(mass);
    }
    return accepted_text(link, mass);
}

/// The order of fullinertia is xx yy zz xy xz yz.
std::string MjcfInertias::accepted_text(const std::string& link, MassProperties mass) {
    if (raise_to_least(mass)) {
        raised_.push_back(link);
    }
    raise_above_rounding(mass);
    written_[link] = mass;
    return "<inertial" + attribute_text("pos", vector_text(mass.center)) +
           attribute_text("mass", numbers_text({&mass.mass, 1})) +
           attribute_text("fullinertia", numbers_text(mass.inertia)) + "/>";
}

/// Returns the stated mass with the centre and inertia of the link's geometry; of a ball of water with that mass if the
/// link has none.
MassProperties MjcfInertias::of_geometry(const std::string& link, const Elements& elements,
                                         const MassProperties& stated) {
    const auto other = invented(link, elements);
    if (!other) {
        return of_ball(stated.mass, stated.center);
    }
    MassProperties result = other->mass;
    for (double& moment : result.inertia) {
        moment *= stated.mass / result.mass;
    }
    result.mass = stated.mass;
    return result;
}

std::optional<MjcfInertias::Invented> MjcfInertias::invented(const std::string& link, const Elements& elements) {
    if (const auto geometry = model_.geometry.find(link); geometry != model_.geometry.end()) {
        if (const auto mass = mass_properties(*geometry->second, density_)) {
            return Invented{*mass, geometry->second->closed() ? &from_geometry_ : &from_open_};
        }
    }
    if (!elements.are_spheres()) {
        if (const auto mass = of_elements(elements, density_)) {
            return Invented{*mass, &from_elements_};
        }
    }
    if (elements.spheres().empty()) {
        return {};
    }
    return Invented{of_spheres(elements.spheres(), density_), &from_spheres_};
}

/// Returns the link with the place of its <inertial>.
std::string MjcfInertias::with_place(const std::string& link) const {
    const int line = model_.robot->find_link(link)->inertial->line;
    return line > 0 ? fmt::format("{} ({}:{})", shown(link), model_.robot->file.string(), line) : shown(link);
}

void MjcfInertias::report(Context& context) const {
    report_stated(context);
    report_invented(context);
}

void MjcfInertias::report_stated(Context& context) const {
    if (!impossible_.empty()) {
        context.log(
            Severity::warning,
            fmt::format("MuJoCo refuses the inertia that the robot states for {}: no body has it; the mass "
                        "stays, centre and inertia are those of the geometry, of the spheres where it has no "
                        "volume, or of a ball of water where there is neither; remedy: correct <inertial>",
                        fmt::join(impossible_, ", ")));
    }
    if (!balanced_.empty()) {
        context.log(Severity::warning,
                    fmt::format("MuJoCo refuses the inertia that the robot states for {}: a principal moment is larger "
                                "than the sum of the two others, which no body has; the mean of the three takes their "
                                "place, as with balanceinertia of MuJoCo; remedy: correct <inertial>",
                                fmt::join(balanced_, ", ")));
    }
    if (!raised_.empty()) {
        context.log(Severity::warning,
                    fmt::format("MuJoCo refuses a mass below 1e-14 kg and a moment of inertia below 1e-14 kg m²; "
                                "those of {} are raised to at least 2e-14; remedy: a robot in other units, such "
                                "as millimetres",
                                fmt::join(raised_, ", ")));
    }
}

void MjcfInertias::report_invented(Context& context) const {
    const auto tell = [&](const std::vector<std::string>& links, const char* source) {
        if (!links.empty()) {
            context.log(Severity::warning,
                        fmt::format("no <inertial> with a mass: {} at {} kg/m³ gives that of {}; remedy: add "
                                    "<inertial> to the robot",
                                    source, number_text(density_), fmt::join(links, ", ")));
        }
    };
    tell(from_geometry_, "the collision geometry");
    tell(from_open_, "the collision geometry, whose meshes are not closed: the winding number decides what lies "
                     "inside,");
    tell(from_spheres_, "the spheres, as the geometry is not known or has no volume,");
    tell(from_elements_, "the elements, as the geometry is not known or has no volume,");
    if (!light_.empty()) {
        context.log(Severity::warning,
                    fmt::format("neither <inertial> with a mass nor collision geometry: MuJoCo refuses bodies that "
                                "move without mass, so these get a millionth of a kilogram: {}; remedy: add <inertial> "
                                "to the robot",
                                fmt::join(light_, ", ")));
    }
}

} // namespace foam::xml_models
