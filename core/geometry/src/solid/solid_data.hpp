// The data of a Solid.
#pragma once

#include "solid/inside_lines.hpp"
#include "mesh/mesh_part.hpp"
#include "solid/part_index.hpp"
#include "convex/kind.hpp"

#include <foam/geometry/internal/surface_runs.hpp>
#include <foam/geometry/solid.hpp>

#include <algorithm>
#include <atomic>
#include <memory>
#include <mutex>
#include <optional>

namespace foam::inline geometry {

/// A mesh that prepares its queries on first use: covering needs none.
class QueriedMesh {
public:
    /// `reading`: nothing if it is made on first use, too.
    QueriedMesh(std::shared_ptr<const Mesh> mesh, std::optional<Reading> reading)
        : mesh_(std::move(mesh)), reading_(std::move(reading)) {}

    bool closed() const { return reading().closed; }
    /// Returns the mesh part. Safe from any number of threads.
    const MeshPart& part() const {
        const MeshPart* const ready = ready_.load(std::memory_order_acquire);
        return ready ? *ready : made();
    }

private:
    const MeshPart& made() const;
    const Reading& reading() const;

    std::shared_ptr<const Mesh> mesh_;
    mutable std::once_flag read_once_;
    mutable std::optional<Reading> reading_;
    mutable std::mutex making_;
    mutable std::optional<MeshPart> part_;
    mutable std::atomic<const MeshPart*> ready_{nullptr};
};

/// One part of the union.
struct PartQueries {
    std::unique_ptr<const QueriedMesh> queried; ///< of a primitive: of its tessellation
    std::optional<PrimitivePart> primitive;
    Box box; ///< of the tessellation
    Covers wanted = Covers::solid; ///< of its part

    const MeshPart& mesh() const { return queried->part(); }
    bool closed() const { return primitive.has_value() || queried->closed(); }
    bool contains(const Vec3& p) const { return primitive ? primitive->signed_distance(p) <= 0 : mesh().contains(p); }
    /// Returns whether covers are to hold its inside.
    bool is_filled() const { return wanted == Covers::solid && closed(); }
    double signed_distance(const Vec3& p) const;
    /// Returns the volume of this part alone; of a mesh that is not closed: with its closing surface.
    double volume() const { return primitive ? primitive->volume() : mesh().signed_volume(); }
};

struct SolidData {
    std::vector<Solid::Part> parts;
    std::shared_ptr<const Mesh> surface = std::make_shared<const Mesh>(); ///< of a single mesh as given: that mesh
    std::vector<std::uint32_t> offsets;
    Box box;
    double area = 0;
    std::vector<PartQueries> queries;
    std::vector<std::size_t> first_triangles; ///< first triangle of each of the queries, in `surface`
    PartIndex index;                          ///< over the queries, if there are many
    bool quick = false;                       ///< made by quick_solid()
    std::shared_ptr<const Solid> base;        ///< of SolidAccess::with_part(): the solid without its last part

    mutable std::once_flag lines_once;
    mutable std::unique_ptr<const InsideLines> lines;
    mutable std::once_flag runs_once;
    mutable std::unique_ptr<const SurfaceRuns> runs;
    mutable std::once_flag coarse_once;
    mutable std::shared_ptr<const Solid> coarse;

    /// Calls visit(part) for the parts that a line may meet.
    template <class Visit> void for_each_along(const Line& line, Visit visit) const {
        if (!index.empty()) {
            index.for_each_along(line, [&](std::uint32_t i) { visit(queries[i]); });
            return;
        }
        for (const PartQueries& part : queries) {
            visit(part);
        }
    }
    bool closed() const {
        return std::all_of(queries.begin(), queries.end(), [](const PartQueries& part) { return part.closed(); });
    }
    bool any_filled() const {
        return std::any_of(queries.begin(), queries.end(), [](const PartQueries& part) { return part.is_filled(); });
    }
    bool all_filled() const {
        return std::all_of(queries.begin(), queries.end(), [](const PartQueries& part) { return part.is_filled(); });
    }
    /// Returns the least signed distance from a part whose inside covers are to hold; infinite if there is none.
    [[gnu::visibility("hidden")]] double distance_to_filled(const Vec3& point) const;
    bool is_primitive() const { return queries.size() == 1 && queries[0].primitive; }
    /// Returns the same as Solid::inside_along().
    Intervals inside_along(const Line& line, std::span<const Solid::Interval> within) const;
};

/// A piece of a piece-wise constant function along a line: the winding number of a mesh and its closing surface, or the
/// inside of a primitive. winding_along() appends such pieces; its `crossings` are those of the line with a part that
/// is a mesh.
struct WindingPiece {
    double enter, leave;
    int winding;
};
void winding_along(const PartQueries& part, const Line& line, std::span<const Crossing> crossings,
                   std::vector<WindingPiece>& pieces);
/// Appends where a line is inside a part, at least on `within`; not united. `pieces` is scratch.
void add_inside_along(const PartQueries& part, const Line& line, std::span<const Crossing> crossings,
                      std::span<const Solid::Interval> within, std::vector<WindingPiece>& pieces, Intervals& result);
/// The whole line.
inline constexpr std::array<Solid::Interval, 1> whole_line{
    {{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()}}};

} // namespace foam::geometry

namespace foam::inline geometry {
struct Solid::Data : geometry::SolidData {};

/// The way from a solid to its data.
struct SolidAccess {
    static const SolidData& data(const Solid& solid) { return *solid.data_; }
    [[gnu::visibility("hidden")]] static std::shared_ptr<const Solid> built(std::unique_ptr<Solid::Data> data);
    static std::shared_ptr<const Solid> quick(std::vector<Solid::Part> parts);
    /// Returns the solid with one more part. What is known of lines through it is not computed again.
    [[gnu::visibility("hidden")]] static std::shared_ptr<const Solid> with_part(std::shared_ptr<const Solid> solid, Solid::Part part);
};
} // namespace foam::geometry
