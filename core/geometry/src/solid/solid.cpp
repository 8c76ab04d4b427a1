#include "mesh/copies.hpp"
#include "solid/solid_data.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/base/error.hpp>
#include <foam/base/internal/activity.hpp>
#include <foam/geometry/internal/own_frame.hpp>
#include <foam/geometry/internal/solids.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <string>
#include <tuple>

namespace foam::inline geometry {
namespace {

void check_mesh(const Mesh& mesh, std::size_t part) {
    const std::string where = "part " + std::to_string(part) + " of the solid";
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
        if (!is_finite(mesh.vertices[i])) {
            throw Error(ErrorCode::geometry, "vertex " + std::to_string(i) + " in " + where +
                                                 " is not finite; repair the mesh or leave its triangles out");
        }
    }
    for (const Triangle& t : mesh.triangles) {
        if (std::max({t[0], t[1], t[2]}) >= mesh.vertices.size()) {
            throw Error(ErrorCode::geometry, "a triangle in " + where + " refers to a vertex that does not exist");
        }
    }
}

/// Returns the mesh without the vertices of no triangle, which would count where vertices stand for the surface.
std::shared_ptr<const Mesh> with_used_vertices(std::shared_ptr<const Mesh> mesh) {
    constexpr std::uint32_t unused = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> name(mesh->vertices.size(), unused);
    for (const Triangle& t : mesh->triangles) {
        for (const std::uint32_t corner : t) {
            name[corner] = 0;
        }
    }
    if (std::find(name.begin(), name.end(), unused) == name.end()) {
        return mesh;
    }
    Mesh result;
    for (std::size_t i = 0; i < name.size(); ++i) {
        if (name[i] != unused) {
            name[i] = static_cast<std::uint32_t>(result.vertices.size());
            result.vertices.push_back(mesh->vertices[i]);
        }
    }
    for (const Triangle& t : mesh->triangles) {
        result.triangles.push_back({name[t[0]], name[t[1]], name[t[2]]});
    }
    return std::make_shared<const Mesh>(std::move(result));
}

/// Returns how finely primitives are tessellated: coarsely where there are so many that their triangles, 2,304 of a
/// sphere, would fill the memory. Proofs and distances use the primitives themselves.
int segments_of(const std::vector<Solid::Part>& parts) {
    constexpr std::ptrdiff_t many = 1'000, very_many = 20'000;
    const auto count =
        std::count_if(parts.begin(), parts.end(), [](const Solid::Part& part) { return part.primitive.has_value(); });
    return count <= many ? 48 : count <= very_many ? 8 : 4;
}

/// Throws Error(geometry) unless all lengths that its kind uses are finite and above zero.
void check_primitive(const Element& primitive) {
    const auto check = [](std::string_view name, double value, bool zero_allowed = false) {
        if (!std::isfinite(value) || value < 0 || (value == 0 && !zero_allowed)) {
            throw Error(ErrorCode::geometry,
                        fmt::format("a collision primitive has a {} that is not a finite length above zero; correct it "
                                    "in the robot file",
                                    name == "size" ? "box size" : name));
        }
    };
    for (const std::string_view name : number_names(primitive.kind)) {
        if (name == "radius") {
            check(name, primitive.radius);
        } else if (name == "length") {
            check(name, primitive.half.z, primitive.kind == Element::Kind::capsule);
        } else if (name != "vertices") {
            check(name, std::min({primitive.half.x, primitive.half.y, primitive.half.z}));
        }
    }
}

/// Returns the part as a mesh in the solid's frame, with its reading; `quick`: without, it is made on first use.
std::pair<std::shared_ptr<const Mesh>, std::optional<geometry::Reading>> part_mesh(const Solid::Part& part,
                                                                                   std::size_t index, int segments,
                                                                                   bool quick) {
    if (part.primitive) {
        check_primitive(*part.primitive);
        Mesh mesh = enclosing_mesh(moved(*part.primitive, part.pose), segments);
        check_mesh(mesh, index);
        geometry::Reading reading{std::vector(mesh.triangles.size(), geometry::Facing::as_given), true};
        return {std::make_shared<const Mesh>(std::move(mesh)), std::move(reading)};
    }
    if (!part.mesh) {
        throw Error(ErrorCode::geometry, "part " + std::to_string(index) +
                                             " of the solid is neither a mesh nor a primitive; give it one of them");
    }
    check_mesh(*part.mesh, index);
    check_cancelled();
    if (quick) {
        return {with_used_vertices(part.mesh), std::nullopt};
    }
    // With many copies of a triangle, every query would look at all of them.
    std::optional<Mesh> once = geometry::without_copies(*part.mesh);
    std::shared_ptr<const Mesh> mesh =
        with_used_vertices(once ? std::make_shared<const Mesh>(std::move(*once)) : part.mesh);
    geometry::Reading reading = geometry::read_as_solid(*mesh);
    return {std::move(mesh), std::move(reading)};
}

/// The surface of a solid as its parts are added. A single mesh as given is shared: it may be large.
class SurfaceOfParts {
public:
    const Mesh& mesh() const { return own_ ? *own_ : *shared_; }
    std::shared_ptr<const Mesh> take() { return own_ ? std::move(own_) : std::move(shared_); }

    /// Adds a mesh with triangles, wound outwards where the outside is known. `facing`: empty if they are as given.
    void add(const std::shared_ptr<const Mesh>& given, std::span<const geometry::Facing> facing) {
        const bool as_given = std::find(facing.begin(), facing.end(), geometry::Facing::flipped) == facing.end();
        if (as_given && mesh().triangles.empty()) {
            shared_ = given;
            return;
        }
        if (!own_) {
            own_ = std::make_shared<Mesh>(*shared_);
        }
        const std::size_t first = own_->triangles.size();
        append(*own_, *given);
        for (std::size_t i = 0; i < facing.size(); ++i) {
            if (Triangle& t = own_->triangles[first + i]; facing[i] == geometry::Facing::flipped) {
                std::swap(t[1], t[2]);
            }
        }
    }

private:
    std::shared_ptr<const Mesh> shared_ = std::make_shared<const Mesh>();
    std::shared_ptr<Mesh> own_;
};

void add_part(geometry::SolidData& data, SurfaceOfParts& surface, std::size_t index, int segments) {
    Solid::Part& part = data.parts[index];
    if (part.primitive) {
        part.pose = part.pose * part.primitive->pose;
        part.primitive->pose = {};
    }
    auto [given, reading] = part_mesh(part, index, segments, data.quick);
    if (!part.primitive) {
        part.mesh = given;
    }
    if (given->triangles.empty()) {
        data.offsets.push_back(data.offsets.back());
        return;
    }
    data.first_triangles.push_back(data.offsets.back());
    using Facings = std::span<const geometry::Facing>;
    surface.add(given, reading ? Facings(reading->facing) : Facings());
    const Box box = geometry::bounds_of_corners(*given);
    data.offsets.push_back(static_cast<std::uint32_t>(surface.mesh().triangles.size()));
    data.box.add(box);
    std::optional<PrimitivePart> primitive;
    if (part.primitive) {
        primitive.emplace(*part.primitive, part.pose);
    }
    data.queries.push_back({std::make_unique<const geometry::QueriedMesh>(std::move(given), std::move(reading)),
                            std::move(primitive), box, part.covers});
}

void index_parts(geometry::SolidData& data) {
    if (data.queries.size() < geometry::PartIndex::many) {
        return;
    }
    std::vector<Box> boxes;
    for (const PartQueries& part : data.queries) {
        boxes.push_back(part.box);
    }
    data.index = geometry::PartIndex(boxes, data.box);
}

/// Returns the nearest of many parts; of equal ones the first.
std::pair<Nearest, std::size_t> nearest_of_many(const geometry::SolidData& data, const Vec3& point) {
    Nearest best{std::numeric_limits<double>::infinity()};
    std::size_t of = data.queries.size();
    data.index.for_each_nearer(
        point, [&] { return std::sqrt(best.squared_distance); },
        [&](std::uint32_t part) {
            constexpr double infinity = std::numeric_limits<double>::infinity();
            const double most = part < of ? std::nextafter(best.squared_distance, infinity) : best.squared_distance;
            Nearest nearest{most};
            data.queries[part].mesh().closest(point, nearest);
            if (nearest.squared_distance < most) {
                best = nearest;
                of = part;
            }
        });
    return {best, of};
}

/// Returns the least signed distance over many parts.
double least_signed_distance(const geometry::SolidData& data, const Vec3& point) {
    double least = std::numeric_limits<double>::infinity();
    data.index.for_each_nearer(
        point, [&] { return std::max(least, 0.0); },
        [&](std::uint32_t i) {
            least = std::min(least, data.queries[i].signed_distance(point));
        });
    return least;
}

/// Fills in the data of a solid but its parts.
void build(geometry::SolidData& data) {
    data.offsets.push_back(0);
    SurfaceOfParts surface;
    const int segments = segments_of(data.parts);
    for (std::size_t i = 0; i < data.parts.size(); ++i) {
        check_cancelled();
        add_part(data, surface, i, segments);
    }
    data.surface = surface.take();
    if (data.surface->triangles.empty()) {
        throw Error(ErrorCode::geometry, "there is no triangle: a solid needs a mesh with triangles or a primitive");
    }
    data.area = surface_area(*data.surface);
    index_parts(data);
}

const geometry::InsideLines& lines_of(const geometry::SolidData& data) {
    // Isolated: a thread that waits inside must not start another task that requests the same lines.
    std::call_once(data.lines_once, [&] {
        isolated([&] { data.lines = std::make_unique<const geometry::InsideLines>(data); });
    });
    return *data.lines;
}

} // namespace

double PartQueries::signed_distance(const Vec3& p) const {
    if (primitive) {
        return primitive->signed_distance(p);
    }
    Nearest nearest{std::numeric_limits<double>::infinity()};
    mesh().closest(p, nearest);
    const double distance = std::sqrt(nearest.squared_distance);
    return mesh().contains(p) ? -distance : distance;
}

double SolidData::distance_to_filled(const Vec3& point) const {
    if (!index.empty() && all_filled()) {
        return least_signed_distance(*this, point);
    }
    double least = std::numeric_limits<double>::infinity();
    for (const PartQueries& part : queries) {
        if (part.is_filled()) {
            least = std::min(least, part.signed_distance(point));
        }
    }
    return least;
}

const geometry::MeshPart& geometry::QueriedMesh::made() const {
    const std::lock_guard lock(making_);
    if (!part_) {
        part_.emplace(*mesh_, reading());
        ready_.store(&*part_, std::memory_order_release);
    }
    return *part_;
}

const geometry::Reading& geometry::QueriedMesh::reading() const {
    std::call_once(read_once_, [&] {
        if (!reading_) {
            reading_ = geometry::read_as_solid(*mesh_);
        }
    });
    return *reading_;
}

Solid::Solid(std::unique_ptr<const Data> data) : data_(std::move(data)) {}
Solid::~Solid() = default;

std::shared_ptr<const Solid> SolidAccess::built(std::unique_ptr<Solid::Data> data) {
    build(*data);
    return std::shared_ptr<const Solid>(new Solid(std::move(data)));
}

std::shared_ptr<const Solid> Solid::make(std::vector<Part> parts) {
    auto data = std::make_unique<Data>();
    data->parts = std::move(parts);
    return SolidAccess::built(std::move(data));
}

std::shared_ptr<const Solid> SolidAccess::with_part(std::shared_ptr<const Solid> solid, Solid::Part part) {
    auto data = std::make_unique<Solid::Data>();
    data->parts = solid->parts();
    data->parts.push_back(std::move(part));
    data->base = std::move(solid);
    return built(std::move(data));
}

std::shared_ptr<const Solid> SolidAccess::quick(std::vector<Solid::Part> parts) {
    auto data = std::make_unique<Solid::Data>();
    data->parts = std::move(parts);
    data->quick = true;
    return built(std::move(data));
}

std::shared_ptr<const Solid> quick_solid(std::vector<Solid::Part> parts) {
    return SolidAccess::quick(std::move(parts));
}

std::shared_ptr<const Solid> Solid::make(Mesh mesh) {
    return make(std::vector<Part>{{std::make_shared<const Mesh>(std::move(mesh)), std::nullopt, Pose{}}});
}

const std::vector<Solid::Part>& Solid::parts() const {
    return data_->parts;
}
const Mesh& Solid::surface() const {
    return *data_->surface;
}
std::span<const std::uint32_t> Solid::part_offsets() const {
    return data_->offsets;
}
const Box& Solid::bounds() const {
    return data_->box;
}
double Solid::area() const {
    return data_->area;
}
bool Solid::closed() const {
    return data_->closed();
}

Covers Solid::covers() const {
    return data_->all_filled() ? Covers::solid : Covers::surface;
}

bool has_solid_parts(const Solid& solid) {
    return SolidAccess::data(solid).any_filled();
}

std::shared_ptr<const Solid> as_surface(const Solid& solid) {
    std::vector<Solid::Part> parts = solid.parts();
    for (Solid::Part& part : parts) {
        part.covers = Covers::surface;
    }
    return Solid::make(std::move(parts));
}

const char* to_string(Covers covers) {
    return covers == Covers::solid ? "solid" : "surface";
}

double Solid::volume() const {
    return data_->is_primitive() ? data_->queries[0].volume() : lines_of(*data_).volume().value;
}

double Solid::volume_error() const {
    return data_->is_primitive() ? 0 : lines_of(*data_).volume().error;
}

double Solid::missing_volume(std::span<const Sphere> spheres) const {
    return lines_of(*data_).outside(spheres);
}

SurfacePoint Solid::closest(const Vec3& point) const {
    Nearest nearest{std::numeric_limits<double>::infinity()};
    std::uint32_t triangle = 0;
    std::size_t query = 0;
    if (!data_->index.empty()) {
        std::tie(nearest, query) = nearest_of_many(*data_, point);
        triangle = static_cast<std::uint32_t>(data_->first_triangles.at(query)) + nearest.triangle;
    }
    for (std::size_t part = 0; data_->index.empty() && part + 1 < data_->offsets.size(); ++part) {
        if (data_->offsets[part] == data_->offsets[part + 1]) {
            continue;
        }
        const double before = nearest.squared_distance;
        data_->queries[query++].mesh().closest(point, nearest);
        if (nearest.squared_distance < before) {
            triangle = data_->offsets[part] + nearest.triangle;
        }
    }
    const auto& [a, b, c] = data_->surface->triangles[triangle];
    const std::vector<Vec3>& v = data_->surface->vertices;
    return {nearest.point, normalized(cross(v[b] - v[a], v[c] - v[a])), triangle};
}

bool Solid::contains(const Vec3& point) const {
    if (!data_->index.empty()) {
        return data_->index.any_at(point, [&](std::uint32_t part) { return data_->queries[part].contains(point); });
    }
    for (const PartQueries& part : data_->queries) {
        if (part.contains(point)) {
            return true;
        }
    }
    return false;
}

double Solid::signed_distance(const Vec3& point) const {
    if (!data_->index.empty()) {
        return least_signed_distance(*data_, point);
    }
    double least = std::numeric_limits<double>::infinity();
    for (const PartQueries& part : data_->queries) {
        least = std::min(least, part.signed_distance(point)); // a part that is farther off may contain the point
    }
    return least;
}

Shape::Shape(std::string name, std::shared_ptr<const Solid> processed, std::shared_ptr<const Solid> original)
    : name_(std::move(name)), processed_(std::move(processed)), original_(std::move(original)) {}
Shape::~Shape() = default;
Shape::Shape(const Shape&) = default;

const geometry::InsideLines& inside_lines(const Solid& solid) {
    return lines_of(SolidAccess::data(solid));
}

} // namespace foam::inline geometry
