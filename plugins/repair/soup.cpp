#include "soup.hpp"

#include <fmt/format.h>

namespace foam::repair {
namespace {

/// Counts of the repairs, reported once they succeeded.
class Deeds {
public:
    void add(std::size_t count, const char* what) {
        if (count > 0) {
            list_.push_back(fmt::format("{} {}", count, what));
        }
    }
    void tell(Context& context) const {
        for (const std::string& deed : list_) {
            context.log(Severity::info, deed);
        }
    }

private:
    std::vector<std::string> list_;
};

double seam_width(const Cleaned& cleaned, const SoupOptions& options) {
    return options.seam * bounds(cleaned.distinct).diagonal();
}

/// Tries sound(). `sewn`: receives the mesh with closed seams, once it is made.
std::optional<Mesh> tried_as_sound(const Cleaned& cleaned, const SoupOptions& options, Mesh& sewn, Context& context) {
    if (std::optional<Mesh> closed = closed_manifold(cleaned.distinct, context)) {
        return closed;
    }
    if (cleaned.all.triangles.size() != cleaned.distinct.triangles.size()) {
        if (std::optional<Mesh> closed = closed_manifold(cleaned.all, context)) {
            return closed;
        }
    }
    sewn = welded_within(cleaned.distinct, seam_width(cleaned, options));
    if (sewn.vertices.size() == cleaned.distinct.vertices.size()) {
        return std::nullopt; // no seam: tried already
    }
    std::optional<Mesh> closed = closed_manifold(sewn, context);
    if (closed) {
        context.log(Severity::info, fmt::format("seams narrower than {:g} of the size were closed", options.seam));
    }
    return closed;
}

} // namespace

std::optional<Mesh> sound(const Cleaned& cleaned, const SoupOptions& options, Context& context) {
    Mesh sewn;
    return tried_as_sound(cleaned, options, sewn, context);
}

std::optional<Mesh> repaired(const Cleaned& cleaned, const SoupOptions& options, Context& context) {
    Mesh mesh;
    if (std::optional<Mesh> closed = tried_as_sound(cleaned, options, mesh, context)) {
        return closed;
    }
    Deeds deeds;
    deeds.add(cleaned.distinct.vertices.size() - mesh.vertices.size(), "vertices along seams sewn together");
    if (mesh.triangles.empty()) {
        return std::nullopt;
    }
    deeds.add(join_t_junctions(mesh, seam_width(cleaned, options)), "T-junctions joined");
    const FacingReport facing = face_outwards(mesh, context);
    deeds.add(facing.turned, "triangles turned to face outwards");
    deeds.add(facing.walls, "triangles between bodies taken out");
    deeds.add(fill_holes(mesh, options.largest_hole * bounds(mesh).diagonal(), context), "holes filled");
    std::optional<Mesh> closed = closed_manifold(welded(mesh), context);
    if (closed) {
        deeds.tell(context);
    }
    return closed;
}

} // namespace foam::repair
