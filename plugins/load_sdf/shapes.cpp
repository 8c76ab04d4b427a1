#include "shapes.hpp"

#include <foam/base/text.hpp>
#include <foam/geometry/polygon.hpp>

#include <sdf/Box.hh>
#include <sdf/Capsule.hh>
#include <sdf/Cylinder.hh>
#include <sdf/Ellipsoid.hh>
#include <sdf/Geometry.hh>
#include <sdf/Material.hh>
#include <sdf/Sphere.hh>
#include <sdf/Surface.hh>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace foam::load_sdf {
namespace {

Vec3 vector_of(const ignition::math::Vector3d& v) {
    return {v.X(), v.Y(), v.Z()};
}

/// Returns the mesh of a polygon that is extruded from z = 0 to the height, as Gazebo makes it (gz-common,
/// MeshManager::CreateExtrudedPolyline).
Mesh extruded(const std::vector<Vec3>& corners, double height) {
    std::size_t work = 300'000'000; // as load.mesh has it for a file
    Mesh mesh;
    const auto count = static_cast<std::uint32_t>(corners.size());
    mesh.vertices = corners;
    for (const Vec3& corner : corners) {
        mesh.vertices.push_back(corner + Vec3{0, 0, height});
    }
    for (const Triangle& t : triangulated(corners, work)) {
        mesh.triangles.push_back({t[0], t[2], t[1]}); // seen from below
        mesh.triangles.push_back({t[0] + count, t[1] + count, t[2] + count});
    }
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t next = (i + 1) % count;
        mesh.triangles.push_back({i, next, next + count});
        mesh.triangles.push_back({i, next + count, i + count});
    }
    return mesh;
}

double doubled_area(const std::vector<Vec3>& corners) {
    double area = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        area += cross(corners[i], corners[(i + 1) % corners.size()]).z;
    }
    return area;
}

std::shared_ptr<const Material> material_of(const ::sdf::Visual& visual) {
    const ::sdf::Material* material = visual.Material();
    if (!material || !material->Element() || !material->Element()->HasElement("diffuse")) {
        return nullptr;
    }
    const ignition::math::Color c = material->Diffuse();
    return std::make_shared<const Material>(Material{
        .name = "", .rgba = std::array<double, 4>{c.R(), c.G(), c.B(), c.A()}, .texture = ""});
}

} // namespace

Pose pose_of(const ignition::math::Pose3d& pose) {
    const auto& q = pose.Rot();
    return from_quaternion(vector_of(pose.Pos()), {q.W(), q.X(), q.Y(), q.Z()});
}

double Shapes::above_zero(double size, const char* what, const ::sdf::ElementPtr& element) const {
    if (!(size > 0) || !std::isfinite(size)) {
        document_.fail(element, fmt::format("the {} is {}; remedy: a number above 0", what, number_text(size)));
    }
    return size;
}

MeshReference Shapes::mesh(const ::sdf::Mesh& source, const std::string& link) const {
    MeshReference mesh{.uri = source.Uri(), .path = {}, .scale = vector_of(source.Scale())};
    const std::string where =
        fmt::format("{}: mesh '{}' of link '{}'", document_.shown_place(source.Element()), shown(mesh.uri), shown(link));
    if (mesh.scale.x == 0 || mesh.scale.y == 0 || mesh.scale.z == 0) {
        document_.fail(source.Element(), "<scale> flattens the mesh to nothing: no factor may be 0; remedy: 1 1 1");
    }
    if (!source.Submesh().empty()) {
        mesh.problem = fmt::format("{}: the part '{}' of it is wanted, and foam reads whole meshes; remedy: a file of "
                                   "that part, without <submesh>",
                                   where, shown(source.Submesh()));
        return mesh;
    }
    const std::filesystem::path folder = document_.place_of(source.Element()).file.parent_path();
    const ResolvedResource found = references_.mesh(mesh.uri, folder);
    mesh.path = found.path;
    if (!found.found()) {
        mesh.problem = fmt::format("{} is not found{}\n{}", where, places_text(found), remedy_for(mesh.uri));
    } else if (!found.fault.empty()) {
        context_.log(Severity::warning,
                     fmt::format("{} is taken to be {}: {}; remedy: <uri>{}</uri>", where, shown(found.path.string()),
                                 found.fault, shown(found.path.lexically_proximate(folder).string())));
    }
    return mesh;
}

MeshReference Shapes::polyline(const ::sdf::ElementPtr& source) const {
    std::vector<Vec3> corners;
    for (auto point = source->GetElement("point"); point; point = point->GetNextElement("point")) {
        const auto p = point->Get<ignition::math::Vector2d>();
        if (corners.empty() || corners.back() != Vec3{p.X(), p.Y(), 0}) {
            corners.push_back({p.X(), p.Y(), 0});
        }
    }
    if (corners.size() > 1 && corners.front() == corners.back()) {
        corners.pop_back();
    }
    const double area = doubled_area(corners);
    if (corners.size() < 3 || area == 0) {
        document_.fail(source, "<polyline> has no area; remedy: at least three points, not in a line");
    }
    if (source->GetNextElement("polyline")) {
        document_.fail(source, "several <polyline> in one <geometry> have holes, which foam does not read; remedy: a "
                               "<collision> for each, or a mesh");
    }
    if (area < 0) {
        std::reverse(corners.begin(), corners.end());
    }
    const double height = above_zero(source->Get<double>("height"), "height of <polyline>", source);
    return {.uri = "", .path = {}, .mesh = std::make_shared<const Mesh>(extruded(corners, height))};
}

std::optional<Geometry> Shapes::other_shape(const ::sdf::Geometry& geometry, const ::sdf::ElementPtr& element) const {
    const ::sdf::ElementPtr source = geometry.Element();
    if (source && source->HasElement("polyline")) {
        return polyline(source->GetElement("polyline"));
    }
    if (source && source->HasElement("image")) {
        document_.fail(element, "an <image> is no shape that foam reads; remedy: a mesh");
    }
    if (source && source->HasElement("cone")) { // of SDF 1.12
        return cone(source->GetElement("cone"));
    }
    const ::sdf::ElementPtr unknown = source ? source->GetFirstElement() : nullptr;
    if (unknown && unknown->GetName() != "empty") {
        document_.fail(element, fmt::format("foam knows no shape <{}>; remedy: another shape, or a mesh",
                                            shown(unknown->GetName())));
    }
    return std::nullopt; // <empty/>
}

MeshReference Shapes::cone(const ::sdf::ElementPtr& source) const {
    const auto number = [&](const char* name) {
        const ::sdf::ElementPtr child = source->HasElement(name) ? source->GetElement(name) : nullptr;
        const auto value = child && child->GetValue() ? child->Get<double>() : 1.0;
        return above_zero(value, fmt::format("{} of <cone>", name).c_str(), source);
    };
    const Mesh mesh = cone_mesh(number("radius"), number("length"));
    return {.uri = "", .path = {}, .mesh = std::make_shared<const Mesh>(mesh)};
}

void Shapes::take_hull(MeshReference& mesh, const ::sdf::Mesh& source) {
    if (!mesh.problem.empty() || !optimizations_.is_hull(source, document_)) {
        return;
    }
    if (!meshes_) {
        document_.fail(source.Element(), "no plugin has load.mesh, which reads the mesh for its hull");
    }
    QuietContext quiet;
    const auto hull = convex_hull(meshes_->load(mesh.path, quiet).vertices);
    if (!hull) {
        document_.fail(source.Element(), "the mesh collides as its hull, and its points span no volume; remedy: mend the "
                                         "mesh, or write no optimization");
    }
    mesh.mesh = std::make_shared<const Mesh>(hull->surface);
}

std::optional<Geometry> Shapes::shape(const ::sdf::Geometry& geometry, const ::sdf::ElementPtr& element,
                                      const std::string& link, bool& ground) const {
    using Type = ::sdf::GeometryType;
    const auto checked = [&](double size, const char* what) { return above_zero(size, what, element); };
    switch (geometry.Type()) {
    case Type::BOX: {
        const Vec3 size = vector_of(geometry.BoxShape()->Size());
        checked(std::min({size.x, size.y, size.z}), "smallest size of <box>");
        return Element::box(size);
    }
    case Type::SPHERE:
        return Element::sphere(checked(geometry.SphereShape()->Radius(), "radius of <sphere>"));
    case Type::CYLINDER:
        return Element::cylinder(checked(geometry.CylinderShape()->Radius(), "radius of <cylinder>"),
                                 checked(geometry.CylinderShape()->Length(), "length of <cylinder>"));
    case Type::CAPSULE: { // its length is without caps, and may be 0
        const double length = geometry.CapsuleShape()->Length();
        return Element::capsule(checked(geometry.CapsuleShape()->Radius(), "radius of <capsule>"),
                                length == 0 ? 0 : checked(length, "length of <capsule>"));
    }
    case Type::ELLIPSOID: {
        const Vec3 radii = vector_of(geometry.EllipsoidShape()->Radii());
        checked(std::min({radii.x, radii.y, radii.z}), "smallest of <radii>");
        return Element::ellipsoid(radii);
    }
    case Type::MESH:
        return mesh(*geometry.MeshShape(), link);
    case Type::PLANE:
    case Type::HEIGHTMAP:
        ground = true;
        return std::nullopt;
    case Type::EMPTY:
        break;
    }
    return other_shape(geometry, element);
}

template <class Source>
std::optional<GeometryElement> Shapes::element(const Source& source, const std::string& link, bool& ground) const {
    ignition::math::Pose3d pose;
    document_.require_none(source.SemanticPose().Resolve(pose));
    auto geometry = shape(*source.Geom(), source.Element(), link, ground);
    if (!geometry) {
        return std::nullopt;
    }
    return GeometryElement{.origin = pose_of(pose),
                           .geometry = std::move(*geometry),
                           .name = source.Name(),
                           .line = document_.own_line(source.Element())};
}

std::optional<GeometryElement> Shapes::collision(const ::sdf::Collision& source, const std::string& link) {
    const ::sdf::Surface* surface = source.Surface();
    if (surface && surface->Contact() && surface->Contact()->CollideBitmask() == 0) {
        ++masked_; // as read.sdf has it
        return std::nullopt;
    }
    bool ground = false;
    auto result = element(source, link, ground);
    ground_ += ground ? 1 : 0;
    if (auto* mesh = result ? std::get_if<MeshReference>(&result->geometry) : nullptr; mesh && source.Geom()->MeshShape()) {
        take_hull(*mesh, *source.Geom()->MeshShape());
    }
    return result;
}

std::optional<GeometryElement> Shapes::visual(const ::sdf::Visual& source, const std::string& link) {
    bool ground = false;
    auto result = element(source, link, ground);
    if (result) {
        result->material = material_of(source);
    }
    return result;
}

void Shapes::add(Link& link, const ::sdf::Link& source) {
    for (std::uint64_t i = 0; i < source.CollisionCount(); ++i) {
        if (auto element = collision(*source.CollisionByIndex(i), link.name)) {
            link.collisions.push_back(std::move(*element));
        }
    }
    for (std::uint64_t i = 0; i < source.VisualCount(); ++i) {
        if (auto element = visual(*source.VisualByIndex(i), link.name)) {
            link.visuals.push_back(std::move(*element));
        }
    }
}

void Shapes::report() const {
    if (ground_ > 0) {
        context_.log(Severity::info, fmt::format("{} with contact: no elements cover a plane or a height field",
                                                 counted(ground_, "plane or height field")));
    }
    if (masked_ > 0) {
        context_.log(Severity::info, fmt::format("{} with <collide_bitmask> 0: nothing touches {}",
                                                 counted(masked_, "collision"), masked_ == 1 ? "it" : "them"));
    }
}

} // namespace foam::load_sdf
