#include "soup.hpp"

#include "facing.hpp"
#include "holes.hpp"
#include "junctions.hpp"
#include "weld.hpp"

#include <fmt/format.h>

namespace foam::repair {
namespace {

/// Counts of what was done, told once it has led to something.
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

} // namespace

std::optional<Mesh> sound(const Cleaned& cleaned, const SoupOptions& options, Context& context) {
    for (const Mesh* candidate : {&cleaned.distinct, &cleaned.all}) {
        if (std::optional<Mesh> closed = closed_manifold(*candidate, context)) {
            return closed;
        }
    }
    const Mesh sewn = welded_within(cleaned.distinct, options.seam * bounds(cleaned.distinct).diagonal());
    std::optional<Mesh> closed = closed_manifold(sewn, context);
    if (closed) {
        context.log(Severity::info, fmt::format("seams narrower than {:g} of the size were closed", options.seam));
    }
    return closed;
}

std::optional<Mesh> mended(const Cleaned& cleaned, const SoupOptions& options, Context& context) {
    if (std::optional<Mesh> closed = sound(cleaned, options, context)) {
        return closed;
    }
    const double tolerance = options.seam * bounds(cleaned.distinct).diagonal();
    Deeds deeds;
    Mesh mesh = welded_within(cleaned.distinct, tolerance);
    deeds.add(cleaned.distinct.vertices.size() - mesh.vertices.size(), "vertices along seams sewn together");
    if (mesh.triangles.empty()) {
        return std::nullopt;
    }
    deeds.add(join_t_junctions(mesh, tolerance), "T-junctions joined");
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
