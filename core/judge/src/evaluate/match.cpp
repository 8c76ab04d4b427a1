// The assignment of spheres in a file to links of a robot.
#include <foam/base/error.hpp>
#include <foam/base/text.hpp>
#include <foam/judge/evaluate.hpp>
#include <foam/sdk/kinds.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace foam::inline judge {
namespace {

/// Renames a link: a rename of the whole name comes first, then the longest prefix.
std::string renamed(const std::string& link, const Renames& renames) {
    const std::pair<std::string, std::string>* best = nullptr;
    for (const auto& rename : renames) {
        if (rename.first == link) {
            return rename.second;
        }
        if (!rename.first.empty() && link.starts_with(rename.first) &&
            (!best || rename.first.size() > best->first.size())) {
            best = &rename;
        }
    }
    return best ? best->second + link.substr(best->first.size()) : link;
}

class Matcher {
public:
    Matcher(const Original& original, MatchedModel& model, const Renames& renames)
        : original_(original), model_(model), renames_(renames) {}

    void run() {
        model_.elements.resize(original_.links.size());
        for (const LinkSpheres& link : model_.file.links) {
            place(link);
        }
        bool any = false;
        for (std::size_t i = 0; i < original_.links.size(); ++i) {
            any = any || !model_.elements[i].empty();
        }
        if (!any) {
            fail_unmatched();
        }
        note_what_is_missing();
    }

private:
    /// Returns the index of the link in the original robot; if there is none, the number of its links.
    std::size_t find(const std::string& link) const {
        const auto it = std::find_if(original_.links.begin(), original_.links.end(),
                                     [&](const OriginalLink& l) { return l.link == link; });
        return static_cast<std::size_t>(it - original_.links.begin());
    }

    void put(std::size_t i, const LinkSpheres& link, const Pose& pose) {
        model_.elements[i].add(pose == Pose{} ? link.elements : moved(link.elements, pose));
    }

    void place(const LinkSpheres& link) {
        const std::string name = renamed(link.link, renames_);
        if (link.elements.empty()) {
            return;
        }
        const std::string content = counts_text(kinds_of(link.elements));
        if (name.empty()) {
            if (original_.links.size() != 1) {
                throw Error(ErrorCode::input,
                            fmt::format("{}: the spheres name no link, and {} has {}; remedy: --rename =LINK",
                                        model_.file.file.string(), original_.file.string(),
                                        counted(original_.links.size(), "link")));
            }
            put(0, link, {});
            return;
        }
        if (const std::size_t i = find(name); i < original_.links.size()) {
            put(i, link, {});
            return;
        }
        if (const Link* known = original_.robot->find_link(name)) {
            if (known->collisions.empty()) {
                note(fmt::format("link '{}' has {}, but no geometry to judge them by", name, content));
            }
            return; // a link that is not chosen: the user said so, and the verdict names it
        }
        if (!place_above(link)) {
            note(fmt::format("{} of link '{}' {} ignored: {} has no such link", content, name,
                             link.elements.size() == 1 ? "is" : "are", original_.file.filename().string()));
        }
    }

    /// Assigns the spheres to the nearest link that the original robot has and that this link is fixed to.
    bool place_above(const LinkSpheres& link) {
        Pose pose;
        std::string at = link.link;
        std::set<std::string> seen;
        while (seen.insert(at).second) {
            const auto joint = model_.file.fixed_joints.find(at);
            if (joint == model_.file.fixed_joints.end()) {
                return false;
            }
            pose = joint->second.origin * pose;
            at = joint->second.parent;
            if (const std::size_t i = find(renamed(at, renames_)); i < original_.links.size()) {
                put(i, link, pose);
                ++folded_;
                return true;
            }
        }
        return false;
    }

    void fail_unmatched() const {
        if (model_.file.links.empty()) {
            throw Error(
                ErrorCode::input,
                fmt::format("{}: it holds no spheres ({}); remedy: the geometry comes first and its sphere model "
                            "second; `foam spherize` makes one",
                            model_.file.file.string(), model_.file.format));
        }
        if (std::all_of(model_.file.links.begin(), model_.file.links.end(),
                        [](const LinkSpheres& link) { return link.elements.empty(); })) {
            throw Error(ErrorCode::input, fmt::format("{}: no sphere has a radius above 0; remedy: correct the file",
                                                      model_.file.file.string()));
        }
        std::vector<std::string> theirs, ours;
        for (const LinkSpheres& link : model_.file.links) {
            theirs.push_back(shown(link.link));
        }
        for (const OriginalLink& link : original_.links) {
            ours.push_back(shown(link.link));
        }
        throw Error(ErrorCode::input,
                    fmt::format("{}: none of its links ({}) is a link with collision geometry of {} ({}); remedy: "
                                "--rename OLD=NEW if only the names differ",
                                model_.file.file.string(), fmt::join(theirs, ", "), original_.file.string(),
                                fmt::join(ours, ", ")));
    }

    void note_what_is_missing() {
        if (folded_ > 0) {
            note(fmt::format("{} {} that the robot lacks {} taken with the link that {} fixed to", folded_,
                             folded_ == 1 ? "link" : "links", folded_ == 1 ? "is" : "are",
                             folded_ == 1 ? "it is" : "they are"));
        }
        std::vector<std::string> bare;
        for (std::size_t i = 0; i < original_.links.size(); ++i) {
            if (model_.elements[i].empty()) {
                bare.push_back(original_.links[i].link);
            }
        }
        if (!bare.empty()) {
            note(fmt::format("{} of {} links with collision geometry have no spheres: {}", bare.size(),
                             original_.links.size(), fmt::join(bare, ", ")));
        }
    }

    void note(const std::string& text) { model_.notes.push_back(shown(text)); }

    const Original& original_;
    MatchedModel& model_;
    const Renames& renames_;
    std::size_t folded_ = 0;
};

} // namespace

void rename_links(SphereFile& file, const Renames& renames) {
    for (LinkSpheres& link : file.links) {
        link.link = renamed(link.link, renames);
    }
}

MatchedModel match(const Original& original, SphereFile file, const Renames& renames) {
    MatchedModel model;
    model.notes = file.notes;
    model.file = std::move(file);
    Matcher(original, model, renames).run();
    return model;
}

} // namespace foam::judge
