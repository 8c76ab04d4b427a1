#include "mjcf.hpp"

#include <foam/base/error.hpp>
#include <foam/base/text.hpp>
#include <foam/xml/document.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <set>

namespace foam::xml_models {
namespace {

class MjcfEdit {
public:
    MjcfEdit(const TextFile& into, const MjcfReplacement& what, Context& context)
        : file_(into.file.string()), what_(what), context_(context),
          root_(xml::parse(into.text, file_, ErrorCode::input)), editor_(into.text), shapes_(next_number(*root_)) {
        if (root_->name != "mujoco" || root_->self_closing()) {
            throw Error(ErrorCode::input, fmt::format("{}:{}: <{}> is not the <mujoco> of an MJCF file", file_,
                                                      root_->line, root_->name));
        }
        for (const xml::Element* world : root_->children_named("worldbody")) {
            add_bodies(*world);
        }
        for (const MjcfGeom& geom : geoms_of(*root_, file_)) {
            geoms_[geom.body].push_back(geom);
        }
    }

    void put(const std::vector<LinkSpheres>& links) {
        for (const LinkSpheres& link : links) {
            put(link, body_of(link.link));
        }
        require_known_names();
        if (others_ > 0) {
            context_.log(Severity::warning,
                         fmt::format("{} geom{} with contact {} no sphere{} and stay{}; remedy: collision: true to "
                                     "replace them as well",
                                     others_, others_ == 1 ? "" : "s", others_ == 1 ? "is" : "are",
                                     others_ == 1 ? "" : "s", others_ == 1 ? "s" : ""));
        }
        if (!weighed_by_spheres_.empty()) {
            context_.log(Severity::warning,
                         fmt::format("these bodies have no <inertial>, so MuJoCo takes their mass from their geoms, "
                                     "where overlaps of spheres count twice: {}",
                                     fmt::join(weighed_by_spheres_, ", ")));
        }
    }

    void put_pairs() {
        std::optional<std::vector<IgnoredPair>> found = what_.found;
        if (found) {
            std::erase_if(*found, [&](const IgnoredPair& pair) { // MuJoCo refuses unknown names
                return !bodies_.contains(pair.first) || !bodies_.contains(pair.second);
            });
        }
        const auto pairs = pairs_into(what_.pairs, stated_pairs(), found, context_);
        if (!pairs) {
            return;
        }
        std::vector<std::string> lines;
        for (const IgnoredPair& pair : *pairs) {
            lines.push_back(exclude_text(pair));
        }
        const xml::Element* first = root_->child("contact");
        if (!first && !lines.empty()) {
            editor_.append_child(*root_, fmt::format("<contact>{}</contact>", fmt::join(lines, "")));
        } else if (what_.pairs == PairEdit::replace) {
            for (const xml::Element* contact : root_->children_named("contact")) {
                editor_.replace_children(*contact, contact->children_named("exclude"),
                                         contact == first ? lines : std::vector<std::string>{});
            }
        } else {
            for (const std::string& line : lines) {
                editor_.append_child(*first, line);
            }
        }
    }

    /// Puts the meshes of hulls, and removes those that only replaced geoms referred to.
    void put_meshes() {
        std::set<std::string> used;
        for (const auto& [body, geoms] : geoms_) {
            for (const MjcfGeom& geom : geoms) {
                const std::string* mesh = geom.text("mesh");
                if (mesh && !replaced_.contains(geom.geom)) {
                    used.insert(*mesh);
                }
            }
        }
        for (const xml::Element* mesh : own_meshes(*root_)) {
            if (!used.contains(*mesh->attribute("name"))) {
                editor_.remove(*mesh);
            }
        }
        const xml::Element* asset = root_->child("asset");
        if (asset) {
            for (const std::string& mesh : shapes_.meshes()) {
                editor_.append_child(*asset, mesh);
            }
        } else if (!shapes_.meshes().empty()) {
            editor_.append_child(*root_, fmt::format("<asset>{}</asset>", fmt::join(shapes_.meshes(), "")));
        }
    }

    std::string result() { return editor_.result(); }

private:
    /// Returns the pairs of the <exclude> elements.
    StatedPairs stated_pairs() const {
        StatedPairs stated{.file = file_, .ignored = {}, .decided = {}};
        for (const xml::Element* contact : root_->children_named("contact")) {
            for (const xml::Element* exclude : contact->children_named("exclude")) {
                const std::string* first = exclude->attribute("body1");
                const std::string* second = exclude->attribute("body2");
                if (first && second) {
                    stated.ignored.push_back({*first, *second, ""});
                }
            }
        }
        return stated;
    }

    /// Returns the mesh assets that foam has named.
    static std::vector<const xml::Element*> own_meshes(const xml::Element& root) {
        std::vector<const xml::Element*> meshes;
        for (const xml::Element* asset : root.children_named("asset")) {
            for (const xml::Element* mesh : asset->children_named("mesh")) {
                const std::string* name = mesh->attribute("name");
                if (name && name->starts_with(hull_prefix)) {
                    meshes.push_back(mesh);
                }
            }
        }
        return meshes;
    }

    /// Returns a number above those in the names of foam's meshes.
    static std::size_t next_number(const xml::Element& root) {
        std::size_t next = 1;
        for (const xml::Element* mesh : own_meshes(root)) {
            const std::string_view digits =
                std::string_view(*mesh->attribute("name")).substr(std::string_view(hull_prefix).size());
            std::size_t number = 0;
            std::from_chars(digits.data(), digits.data() + digits.size(), number);
            next = std::max(next, number + 1);
        }
        return next;
    }

    void add_bodies(const xml::Element& parent) {
        for (const xml::Element* body : parent.children_named("body")) {
            if (const std::string* name = body->attribute("name")) {
                bodies_[*name] = body;
            }
            add_bodies(*body);
        }
    }

    const xml::Element& body_of(const std::string& link) const {
        const auto found = bodies_.find(link);
        if (found == bodies_.end()) {
            std::vector<std::string> names;
            for (const auto& [name, body] : bodies_) {
                names.push_back(name);
            }
            const std::string near = nearest_word(link, names);
            throw Error(ErrorCode::input,
                        fmt::format("{}: there is no body '{}' for the link of that name{}; remedy: "
                                    "rename the body, or leave the link out",
                                    file_, shown(link),
                                    near.empty() ? "" : fmt::format(" (there is '{}')", shown(near))));
        }
        return *found->second;
    }

    void put(const LinkSpheres& link, const xml::Element& body) {
        std::vector<const xml::Element*> old;
        for (const MjcfGeom& geom : geoms_[&body]) {
            if (geom.collides() && (geom.sphere() || what_.all_collision)) {
                old.push_back(geom.geom);
                replaced_.insert(geom.geom);
            } else if (geom.collides()) {
                ++others_;
            }
        }
        const bool weighed = body.child("inertial") != nullptr;
        if (!weighed) {
            weighed_by_spheres_.push_back(shown(link.link));
        }
        const std::string* own_class = old.empty() ? nullptr : old.front()->attribute("class");
        const std::string kind = "<geom" + name_of_one(old, link.elements.size()) +
                                 (own_class ? attribute_text("class", *own_class) : std::string());
        const std::string end = std::string(own_class ? "" : R"( group="3" contype="1" conaffinity="1")") +
                                (weighed ? attribute_text("mass", "0") : "");
        std::vector<std::string> geoms;
        for (const Sphere& s : link.elements.spheres()) {
            geoms.push_back(kind + attribute_text("type", "sphere") + end +
                            attribute_text("pos", vector_text(s.center)) +
                            attribute_text("size", numbers_text({&s.radius, 1})) + "/>");
        }
        for (const Element& element : link.elements.shaped()) {
            geoms.push_back(kind + end + shapes_.attributes(element) + "/>");
        }
        editor_.replace_children(body, old, geoms);
    }

    /// Returns ` name=…` where one geom replaces one, so that what names it finds it. The names of others are lost.
    std::string name_of_one(const std::vector<const xml::Element*>& old, std::size_t count) {
        const bool alone = old.size() == 1 && count == 1;
        std::string text;
        for (const xml::Element* geom : old) {
            if (const std::string* name = geom->attribute("name"); name && alone) {
                text = attribute_text("name", *name);
            } else if (name) {
                lost_names_.insert(*name);
            }
        }
        return text;
    }

    /// Throws if an element names a geom whose name is lost.
    void require_known_names() const {
        std::vector<Naming> found;
        add_naming(*root_, found);
        if (!found.empty()) {
            const auto& [element, attribute] = found.front();
            std::vector<int> others;
            for (const Naming& other : found) {
                if (other.element->line != (others.empty() ? element->line : others.back())) {
                    others.push_back(other.element->line);
                }
            }
            throw Error(
                ErrorCode::input,
                fmt::format("{}:{}: <{} {}=\"{}\"> names a geom that is replaced by others without names, so "
                            "MuJoCo would refuse the file{}; remedy: remove <{}>, or keep the geom by "
                            "contype=\"0\" conaffinity=\"0\"",
                            file_, element->line, element->name, attribute, shown(*element->attribute(attribute)),
                            others.empty() ? ""
                                           : fmt::format(" (so do{} {})", others.size() == 1 ? "es line" : " lines",
                                                         fmt::join(others, ", ")),
                            element->name));
        }
        warn_of_included(*root_);
    }

    struct Naming {
        const xml::Element* element = nullptr;
        const char* attribute = nullptr;
    };

    /// Adds the elements that name lost geoms: pairs, sensors, tendons, tuples. All use these few attributes.
    void add_naming(const xml::Element& element, std::vector<Naming>& found) const {
        const auto add = [&](const char* attribute, const char* type) {
            const std::string *name = element.attribute(attribute), *of = type ? element.attribute(type) : nullptr;
            if (name && lost_names_.contains(*name) && (!type || (of && *of == "geom"))) {
                found.push_back({&element, attribute});
            }
        };
        add("geom", nullptr);
        add("geom1", nullptr);
        add("geom2", nullptr);
        add("objname", "objtype");
        add("refname", "reftype");
        for (const auto& child : element.children) {
            add_naming(*child, found);
        }
    }

    void warn_of_included(const xml::Element& element) const {
        if (element.name == "include" && !lost_names_.empty()) {
            std::vector<std::string> names;
            for (const std::string& name : lost_names_) {
                names.push_back(shown(name));
            }
            context_.log(Severity::warning,
                         fmt::format("{}:{}: the file that is included may name geoms that are replaced by others "
                                     "without names: {}; remedy: remove what names them",
                                     file_, element.line, fmt::join(names, ", ")));
        }
        for (const auto& child : element.children) {
            warn_of_included(*child);
        }
    }

    std::string file_;
    const MjcfReplacement& what_;
    Context& context_;
    std::unique_ptr<const xml::Element> root_;
    xml::Editor editor_;
    std::map<std::string, const xml::Element*> bodies_;
    std::map<const xml::Element*, std::vector<MjcfGeom>> geoms_;
    std::size_t others_ = 0;
    std::vector<std::string> weighed_by_spheres_;
    MjcfShapes shapes_;
    std::set<const xml::Element*> replaced_; ///< geoms
    std::set<std::string> lost_names_;       ///< of geoms
};

} // namespace

std::string with_spheres(const TextFile& into, const std::vector<LinkSpheres>& links, const MjcfReplacement& what,
                         Context& context) {
    MjcfEdit edit(into, what, context);
    edit.put(links);
    edit.put_meshes();
    edit.put_pairs();
    return edit.result();
}

std::string exclude_text(const IgnoredPair& pair) {
    return "<exclude" + attribute_text("body1", pair.first) + attribute_text("body2", pair.second) + "/>";
}

} // namespace foam::xml_models
