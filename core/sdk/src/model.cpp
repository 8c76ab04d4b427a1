#include <foam/base/error.hpp>
#include <foam/sdk/model.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace foam::inline sdk {
namespace {

const std::vector<Sphere>& spheres_at(const SphereGroup& group, int level) {
    const std::vector<SphereTree::Level>& levels = group.tree.levels;
    if (levels.empty()) {
        throw Error(ErrorCode::output, fmt::format("link '{}' has no spheres to write", group.link));
    }
    const bool finest = level < 0 || static_cast<std::size_t>(level) >= levels.size();
    return finest ? levels.back().spheres : levels[static_cast<std::size_t>(level)].spheres;
}

void require_writable(const std::vector<Sphere>& spheres, const std::string& link) {
    if (spheres.empty()) {
        throw Error(ErrorCode::output, fmt::format("link '{}' has no spheres to write", link));
    }
    for (std::size_t i = 0; i < spheres.size(); ++i) {
        const Sphere& s = spheres[i];
        if (!is_finite(s.center) || !std::isfinite(s.radius) || !(s.radius > 0)) {
            throw Error(
                ErrorCode::output,
                fmt::format("sphere {} of link '{}', center {} {} {}, radius {}, cannot be written: the numbers "
                            "must be finite and the radius above 0",
                            i, link, s.center.x, s.center.y, s.center.z, s.radius));
        }
    }
}

} // namespace

std::vector<Sphere>& spheres_of(SphereFile& file, const std::string& link) {
    auto it = std::find_if(file.links.begin(), file.links.end(), [&](const LinkSpheres& l) { return l.link == link; });
    if (it == file.links.end()) {
        it = file.links.insert(it, {link, {}});
    }
    return it->spheres;
}

std::vector<LinkSpheres> spheres_by_link(const SphereModel& model, int level) {
    std::vector<LinkSpheres> links;
    for (const SphereGroup& group : model.groups) {
        const std::vector<Sphere>& spheres = spheres_at(group, level);
        require_writable(spheres, group.link);
        auto it = std::find_if(links.begin(), links.end(),
                               [&](const LinkSpheres& known) { return known.link == group.link; });
        if (it == links.end()) {
            it = links.insert(links.end(), {group.link, {}});
        }
        it->spheres.insert(it->spheres.end(), spheres.begin(), spheres.end());
    }
    return links;
}

void require_writable(const SphereModel& model) {
    spheres_by_link(model);
    for (const SphereGroup& group : model.groups) {
        for (const SphereTree::Level& level : group.tree.levels) {
            require_writable(level.spheres, group.link);
        }
    }
}

} // namespace foam::sdk
