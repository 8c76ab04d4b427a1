#include <foam/base/error.hpp>
#include <foam/base/text.hpp>
#include <foam/sdk/elements.hpp>
#include <foam/sdk/kinds.hpp>
#include <foam/sdk/writing.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace foam::inline sdk {
namespace {

/// Spheres that a distance added to their radii switches off.
struct Switched {
    std::size_t count = 0;
    std::string link; ///< of the first
    double radius = 0, distance = 0;

    void add(const std::string& link_of_sphere, double radius_of_sphere, double distance_of_link) {
        if (count++ == 0) {
            link = link_of_sphere;
            radius = radius_of_sphere;
            distance = distance_of_link;
        }
    }
    std::string spheres() const { return fmt::format("{} sphere{}", count, count == 1 ? "" : "s"); }
    std::string first() const {
        return fmt::format("{}link '{}', {} m - {} m", count == 1 ? "" : "the first: ", link, radius, -distance);
    }
};

const SphereTree::Level& level_of(const SphereGroup& group, int level) {
    const std::vector<SphereTree::Level>& levels = group.tree.levels;
    if (levels.empty()) {
        throw Error(ErrorCode::output, fmt::format("link '{}' has no spheres to write", group.link));
    }
    const bool finest = level < 0 || static_cast<std::size_t>(level) >= levels.size();
    return finest ? levels.back() : levels[static_cast<std::size_t>(level)];
}

void require_writable(const Sphere& s, std::size_t index, const std::string& link) {
    if (!is_finite(s.center) || !std::isfinite(s.radius) || !(s.radius > 0)) {
        throw Error(ErrorCode::output,
                    fmt::format("sphere {} of link '{}', center {} {} {}, radius {}, cannot be written: the numbers "
                                "must be finite and the radius above 0",
                                index, link, s.center.x, s.center.y, s.center.z, s.radius));
    }
}

void require_writable(const Elements& elements, const std::string& link) {
    if (elements.empty()) {
        throw Error(ErrorCode::output, fmt::format("link '{}' has no spheres to write", link));
    }
    for (std::size_t i = 0; i < elements.spheres().size(); ++i) {
        require_writable(elements.spheres()[i], i, link);
    }
    for (std::size_t i = elements.spheres().size(); i < elements.size(); ++i) {
        if (const Element element = elements[i]; !is_valid(element)) {
            throw Error(ErrorCode::output,
                        fmt::format("{} {} of link '{}' cannot be written: its numbers must be finite, its pose a "
                                    "rotation and a translation, and its volume above 0",
                                    to_string(element.kind), i, link));
        }
    }
}

} // namespace

std::vector<Sphere>& spheres_of(SphereFile& file, const std::string& link) {
    return link_of(file, link).elements.spheres();
}

LinkSpheres& link_of(SphereFile& file, const std::string& link) {
    auto it = std::find_if(file.links.begin(), file.links.end(), [&](const LinkSpheres& l) { return l.link == link; });
    if (it == file.links.end()) {
        it = file.links.insert(it, {link, {}});
    }
    return *it;
}

std::vector<LinkSpheres> elements_by_link(const SphereModel& model, int level) {
    std::vector<LinkSpheres> links;
    for (const SphereGroup& group : model.groups) {
        const Elements& elements = level_of(group, level).elements;
        require_writable(elements, group.link);
        auto it = std::find_if(links.begin(), links.end(),
                               [&](const LinkSpheres& known) { return known.link == group.link; });
        if (it == links.end()) {
            it = links.insert(links.end(), {group.link, {}});
        }
        it->elements.add(elements);
    }
    return links;
}

void add_buffers(SphereFile& file) {
    Switched off;
    for (LinkSpheres& link : file.links) {
        const auto found = file.buffers.find(link.link);
        const double buffer = found == file.buffers.end() ? 0 : found->second;
        std::erase_if(link.elements.spheres(), [&](Sphere& s) {
            const bool with = s.radius + buffer > 0, without = s.radius > 0;
            if (without && !with) {
                off.add(link.link, s.radius, buffer);
            }
            s.radius += with ? buffer : 0;
            return without && !with;
        });
    }
    if (off.count > 0) {
        file.notes.push_back(fmt::format("the buffer switches {} off, which {} left out ({})", off.spheres(),
                                         off.count == 1 ? "is" : "are", off.first()));
    }
    file.buffers.clear();
}

std::vector<std::string> uncovered_links(const SphereModel& model) {
    const auto has_elements = [&](const Link& link) {
        return std::any_of(model.groups.begin(), model.groups.end(),
                           [&](const SphereGroup& group) { return group.link == link.name; });
    };
    std::vector<std::string> links;
    if (!model.robot) {
        return links;
    }
    for (const Link& link : model.robot->links) {
        if (!link.collisions.empty() && !has_elements(link)) {
            links.push_back(link.name);
        }
    }
    return links;
}

std::vector<KeptGeometry> kept_geometry(const SphereModel& model) {
    std::vector<KeptGeometry> kept;
    const std::vector<std::string>& none = model.without_collision;
    for (const std::string& name : uncovered_links(model)) {
        const Link* link = model.robot->find_link(name);
        if (!link || std::find(none.begin(), none.end(), name) != none.end()) {
            continue;
        }
        KeptGeometry& geometry = kept.emplace_back(KeptGeometry{name, {}, false});
        for (const GeometryElement& element : link->collisions) {
            if (const auto* primitive = std::get_if<Element>(&element.geometry)) {
                geometry.primitives.add(moved(*primitive, element.origin));
            } else {
                geometry.meshes = true;
            }
        }
    }
    return kept;
}

std::string path_seen_from(const std::filesystem::path& folder, const std::filesystem::path& file) {
    const std::filesystem::path whole = std::filesystem::absolute(file);
    const std::filesystem::path physical = std::filesystem::weakly_canonical(whole.parent_path()) / whole.filename();
    if (folder.empty()) {
        return physical.generic_string();
    }
    return physical.lexically_relative(std::filesystem::weakly_canonical(std::filesystem::absolute(folder)))
        .generic_string();
}

std::vector<LinkSpheres> spheres_by_link(const SphereModel& model, int level) {
    std::vector<LinkSpheres> links = elements_by_link(model, level);
    for (const LinkSpheres& link : links) {
        if (!link.elements.are_spheres()) {
            throw Error(ErrorCode::output,
                        fmt::format("link '{}' has {}, and this format holds spheres only; remedy: a model of "
                                    "spheres, or a format that holds this kind: write.urdf, write.mjcf, write.json",
                                    link.link, with_article(noun_of(link.elements.shaped().front().kind, 1))));
        }
    }
    return links;
}

void require_writable(const SphereModel& model) {
    elements_by_link(model);
    for (const SphereGroup& group : model.groups) {
        for (const SphereTree::Level& level : group.tree.levels) {
            require_writable(level.elements, group.link);
        }
    }
}

} // namespace foam::inline sdk
