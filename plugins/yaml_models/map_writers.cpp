#include "writers.hpp"

#include <foam/base/error.hpp>
#include <foam/sdk/writing.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace foam::tree {
namespace {

using yaml::Value;

Value rows_of_links(const std::vector<LinkSpheres>& links) {
    Value map = yaml::map();
    for (const LinkSpheres& link : links) {
        Value rows = yaml::list();
        for (const Sphere& s : link.elements.spheres()) {
            rows.items.push_back(yaml::list({s.center.x, s.center.y, s.center.z, s.radius}));
        }
        yaml::append(map, link.link, yaml::map({{"spheres", std::move(rows)}}));
    }
    return map;
}

Value columns_of(const std::vector<Sphere>& spheres) {
    Value centers = yaml::list(), radii = yaml::list();
    for (const Sphere& s : spheres) {
        centers.items.push_back(yaml::list({s.center.x, s.center.y, s.center.z}));
        radii.items.push_back(yaml::real(s.radius));
    }
    return yaml::map({{"centers", std::move(centers)}, {"radii", std::move(radii)}});
}

/// Returns the pairs that are checked: all but those that are ignored.
Value checked_pairs(const std::vector<IgnoredPair>& pairs_to_ignore, const std::vector<LinkSpheres>& links) {
    std::set<std::pair<std::string, std::string>> ignored;
    for (const IgnoredPair& pair : pairs_to_ignore) {
        ignored.insert(std::minmax(pair.first, pair.second));
    }
    Value pairs = yaml::list();
    for (std::size_t a = 0; a < links.size(); ++a) {
        for (std::size_t b = a + 1; b < links.size(); ++b) {
            if (!ignored.contains(std::minmax(links[a].link, links[b].link))) {
                pairs.items.push_back(yaml::list({links[a].link, links[b].link}));
            }
        }
    }
    return pairs;
}

/// Edits the pairs of a file of the user, who has switched off what the file does not list. Links that had no spheres
/// have no pairs yet.
void edit_checked_pairs(yaml::Splice& file, const SphereModel& model, const std::vector<LinkSpheres>& links,
                        PairEdit edit, Context& context) {
    std::set<std::pair<std::string, std::string>> listed;
    const Value* pairs = file.find({"self_collision_pairs"});
    for (const Value& pair : pairs ? pairs->items : std::vector<Value>{}) {
        if (pair.items.size() == 2) {
            listed.insert(std::minmax(pair.items[0].text, pair.items[1].text));
        }
    }
    const Value* known = file.find({"collision_spheres"});
    StatedPairs stated{.file = model.into->file.string(), .ignored = {}, .decided = {}};
    for (std::size_t a = 0; a < links.size(); ++a) {
        for (std::size_t b = a + 1; b < links.size(); ++b) {
            const bool had_spheres = known && known->find(links[a].link) && known->find(links[b].link);
            if (had_spheres && pairs && !listed.contains(std::minmax(links[a].link, links[b].link))) {
                stated.ignored.push_back({links[a].link, links[b].link, ""});
            }
        }
    }
    if (auto ignored = pairs_into(edit, stated, model.ignored_pairs, context)) {
        if (edit == PairEdit::merge) {
            ignored->insert(ignored->end(), stated.ignored.begin(), stated.ignored.end());
        }
        file.set({"self_collision_pairs"}, checked_pairs(*ignored, links));
    }
}

} // namespace

BubblifyWriter::BubblifyWriter(const Parameters&) : TreeWriter("write.bubblify", read_collision_spheres) {}

Value BubblifyWriter::document(const SphereModel&, const std::vector<LinkSpheres>& links, Context&) const {
    std::size_t total = 0;
    for (const LinkSpheres& link : links) {
        total += link.elements.spheres().size();
    }
    return yaml::map({{"collision_spheres", spheres_of_links(links)},
                      {"metadata", yaml::map({{"total_spheres", yaml::integer(static_cast<std::int64_t>(total))},
                                              {"links", yaml::integer(static_cast<std::int64_t>(links.size()))}})}});
}

void BubblifyWriter::edit(yaml::Splice& file, const SphereModel&, const std::vector<LinkSpheres>& links,
                          Context&) const {
    file.set({"collision_spheres"}, spheres_of_links(links));
}

PlainmpWriter::PlainmpWriter(const Parameters& parameters)
    : TreeWriter("write.plainmp", read_collision_spheres), pairs_(pair_edit(parameters)) {}

Value PlainmpWriter::document(const SphereModel& model, const std::vector<LinkSpheres>& links, Context& context) const {
    require_robot(model, name());
    warn_without_pairs(model, context);
    const PlannedJoints joints = planned_joints(model);
    Value document = yaml::map(
        {{"urdf_path", yaml::text(urdf_path(model, context))}, {"control_joint_names", names_of(joints.active)}});
    if (model.ignored_pairs) {
        yaml::append(document, "self_collision_pairs", checked_pairs(*model.ignored_pairs, links));
    }
    const bool base =
        std::any_of(links.begin(), links.end(), [&](const LinkSpheres& link) { return link.link == base_link(model); });
    yaml::append(document, "only_self_collision_links", base ? yaml::list({base_link(model)}) : yaml::list());
    yaml::append(document, "collision_spheres", rows_of_links(links));
    return document;
}

void PlainmpWriter::edit(yaml::Splice& file, const SphereModel& model, const std::vector<LinkSpheres>& links,
                         Context& context) const {
    edit_checked_pairs(file, model, links, pairs_, context);
    file.set({"collision_spheres"}, rows_of_links(links));
}

PyrokiWriter::PyrokiWriter(const Parameters&) : TreeWriter("write.pyroki", read_columns) {}

Value PyrokiWriter::document(const SphereModel&, const std::vector<LinkSpheres>& links, Context&) const {
    Value map = yaml::map();
    for (const LinkSpheres& link : links) {
        yaml::append(map, link.link, columns_of(link.elements.spheres()));
    }
    return map;
}

std::string PyrokiWriter::text_of(const Value& document, const SphereModel&) const {
    return yaml::json_text(document);
}

MorphitWriter::MorphitWriter(const Parameters&) : TreeWriter("write.morphit", read_columns) {}

Value MorphitWriter::document(const SphereModel&, const std::vector<LinkSpheres>& links, Context&) const {
    if (links.size() != 1) {
        throw Error(ErrorCode::output,
                    fmt::format("write.morphit holds the spheres of one body, the model has {} links; "
                                "remedy: skip the others, or write.pyroki for all links",
                                links.size()));
    }
    Value document = columns_of(links.front().elements.spheres());
    yaml::append(document, "link", yaml::text(links.front().link)); // other keys are free
    return document;
}

std::string MorphitWriter::text_of(const Value& document, const SphereModel&) const {
    return yaml::json_text(document);
}

} // namespace foam::tree
