#include "edit.hpp"

#include "collisions.hpp"
#include "links.hpp"
#include "object.hpp"

#include <foam/base/error.hpp>
#include <foam/base/text.hpp>
#include <foam/sdk/writing.hpp>
#include <foam/xml/document.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <set>

namespace foam::sdf {
namespace fs = std::filesystem;
namespace {

using Node = xml::Element;

/// Returns the first <include> of a text; nullptr if there is none.
const Node* include_below(const Node& element) {
    for (const auto& child : element.children) {
        const Node* found = child->name == "include" ? child.get() : include_below(*child);
        if (found) {
            return found;
        }
    }
    return nullptr;
}

class Edit {
public:
    Edit(const SphereModel& model, Context& context)
        : model_(model), context_(context), text_(model.robot->source), file_(model.robot->file.string()),
          root_(xml::parse(text_, file_, ErrorCode::output)), editor_(text_), hulls_(file_name_of(model)) {
        for (const auto& [name, link] : links_of(*root_, file_)) {
            links_.emplace(name, link);
        }
    }

    std::string run(const std::vector<LinkSpheres>& links) {
        for (const LinkSpheres& link : links) {
            put(link);
        }
        for (const std::string& name : model_.without_collision) {
            put({name, {}});
        }
        move_paths();
        return with_provenance(editor_.result(), model_);
    }

private:
    const Node& link_named(const std::string& name) const {
        const auto found = links_.find(name);
        if (found != links_.end()) {
            return *found->second;
        }
        const Node* include = include_below(*root_);
        throw Error(ErrorCode::output,
                    fmt::format("{}:{}: link '{}' is not in this file{}", file_, include ? include->line : root_->line,
                                shown(name),
                                include ? ", but in one that it includes; remedy: the included file as the input, or skip "
                                          "the link, or another format, such as -o robot.urdf"
                                        : "; remedy: give the file that has it"));
    }

    /// Returns whether elements take the place of a collision: those of the ground and those that touch nothing stay.
    bool is_replaced(const Node& collision) const {
        const Node* geometry = collision.child("geometry");
        const bool ground = geometry && (geometry->child("plane") || geometry->child("heightmap"));
        return !ground && !is_masked(collision, text_);
    }

    /// Returns what a collision says beyond its place and its shape.
    std::string settings_of(const Node& collision) const {
        std::string settings;
        for (const auto& child : collision.children) {
            if (child->name != "pose" && child->name != "geometry") {
                settings += text_.substr(child->span.begin, child->span.size());
            }
        }
        return settings;
    }

    /// Returns the settings of the collisions that are replaced; empty, with a warning, where they differ.
    std::string common_settings(const std::string& link, const std::vector<const Node*>& old) const {
        std::set<std::string> found;
        for (const Node* collision : old) {
            found.insert(settings_of(*collision));
        }
        if (found.size() > 1) {
            context_.log(Severity::warning,
                         fmt::format("{}:{}: the collisions of link '{}' have different settings, such as <surface>: the "
                                     "new ones have none; remedy: the same for all, or add them",
                                     file_, old.front()->line, shown(link)));
        }
        return found.size() == 1 ? *found.begin() : "";
    }

    void put(const LinkSpheres& elements) {
        const Node& link = link_named(elements.link);
        std::vector<const Node*> old = link.children_named("collision");
        std::erase_if(old, [&](const Node* collision) { return !is_replaced(*collision); });
        replaced_.insert(old.begin(), old.end());
        std::set<std::string> taken;
        for (const auto& child : link.children) {
            if (child->attribute("name") && std::ranges::find(old, child.get()) == old.end()) {
                taken.insert(*child->attribute("name"));
            }
        }
        // The first one keeps the name of the first one: sensors name collisions.
        const std::string* first = old.empty() ? nullptr : old.front()->attribute("name");
        const std::string settings = old.empty() ? "" : common_settings(elements.link, old);
        std::vector<std::string> children;
        for (const CollisionText& collision : collisions_of(elements, hulls_)) {
            std::string name = first && children.empty() ? *first : collision.name;
            while (!taken.insert(name).second) {
                name += "_";
            }
            children.push_back(fmt::format("<collision name=\"{}\">{}{}{}</collision>", attribute_escaped(name),
                                           collision.pose, collision.geometry, settings));
        }
        if (old.size() != 1 || children.size() != 1) {
            warn_of_sensors(link, old);
        }
        editor_.replace_children(link, old, children);
    }

    /// Warns of sensors that name one of several collisions that were replaced.
    void warn_of_sensors(const Node& link, const std::vector<const Node*>& old) const {
        for (const Node* sensor : link.children_named("sensor")) {
            for (const Node* contact : sensor->children_named("contact")) {
                for (const Node* named : contact->children_named("collision")) {
                    const auto parts = words(content_of(*named, text_));
                    const bool lost = !parts.empty() && std::ranges::any_of(old, [&](const Node* collision) {
                        const std::string* name = collision->attribute("name");
                        return name && *name == parts.front();
                    });
                    if (lost) {
                        context_.log(Severity::warning,
                                     fmt::format("{}:{}: the sensor names the collision '{}', and others take its place; "
                                                 "remedy: name each of them",
                                                 file_, named->line, shown(parts.front())));
                    }
                }
            }
        }
    }

    /// Makes relative paths lead to their files from the folder of the output.
    void move_paths() {
        const fs::path own = fs::weakly_canonical(fs::absolute(file_).parent_path());
        const fs::path folder = model_.folder.empty() ? own : fs::weakly_canonical(model_.folder);
        if (folder != own) {
            move_paths_below(*root_, own, folder);
        }
    }

    void move_paths_below(const Node& element, const fs::path& own, const fs::path& folder) {
        static constexpr std::array with_paths{"uri",           "albedo_map",      "normal_map", "roughness_map",
                                               "metalness_map", "environment_map", "light_map",  "emissive_map"};
        if (replaced_.contains(&element)) {
            return;
        }
        const auto parts = words(content_of(element, text_));
        if (std::ranges::find(with_paths, element.name) != with_paths.end() && parts.size() == 1) {
            const fs::path path(parts.front());
            std::error_code error;
            const bool leads_there = parts.front().find("://") == std::string_view::npos && path.is_relative() &&
                                     fs::exists(own / path, error);
            if (leads_there) {
                const auto begin = static_cast<std::size_t>(parts.front().data() - text_.data());
                editor_.replace({begin, begin + parts.front().size()},
                                markup_escaped(path_seen_from(folder, own / path)));
            }
        }
        for (const auto& child : element.children) {
            move_paths_below(*child, own, folder);
        }
    }

    const SphereModel& model_;
    Context& context_;
    std::string_view text_;
    std::string file_;
    std::unique_ptr<const Node> root_;
    xml::Editor editor_;
    HullNames hulls_;
    std::map<std::string, const Node*> links_;
    std::set<const Node*> replaced_; ///< collisions
};

} // namespace

bool has_sdf_text(const SphereModel& model) {
    return model.robot && is_sdf(model.robot->source);
}

std::string edited_sdf(const SphereModel& model, const std::vector<LinkSpheres>& links, Context& context) {
    return Edit(model, context).run(links);
}

} // namespace foam::sdf
