#include "mjcf.hpp"

#include <foam/base/error.hpp>
#include <foam/base/text.hpp>
#include <foam/xml/document.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <set>

namespace foam::xml_models {
namespace {

class MjcfEdit {
public:
    MjcfEdit(const TextFile& into, const MjcfReplacement& what, Context& context)
        : file_(into.file.string()), what_(what), context_(context), text_(text_of(into)),
          root_(xml::parse(text_, file_, ErrorCode::input)), editor_(text_),
          shapes_(next_number(*root_), mesh_settings(*root_)),
          inertia_from_geoms_(stated_of_compiler("inertiafromgeom")), bodies_(bodies_of(*root_)),
          in_pairs_(names_in_pairs(*root_)) {
        if (root_->name != "mujoco" || root_->self_closing()) {
            throw Error(ErrorCode::input, fmt::format("{}:{}: <{}> is not the <mujoco> of an MJCF file", file_,
                                                      root_->line, root_->name));
        }
        for (const MjcfGeom& geom : geoms_of(*root_, file_)) {
            geoms_[geom.body].push_back(geom);
            const std::string* name = geom.geom->attribute("name");
            names_.insert(name ? *name : "");
        }
    }

    void put(std::vector<LinkSpheres> links) {
        for (const std::string& link : what_.emptied) {
            if (bodies_.contains(link)) {
                links.push_back({link, {}});
            }
        }
        add_uses(*root_);
        for (const LinkSpheres& link : links) {
            put(link, body_of(link.link));
        }
        put_pairs_of_replaced(editor_, *root_, lost_, file_, context_);
        if (others_ > 0) {
            context_.log(Severity::warning,
                         fmt::format("{} geom{} with contact {} no sphere{} and stay{}; remedy: collision: true to "
                                     "replace them as well",
                                     others_, others_ == 1 ? "" : "s", others_ == 1 ? "is" : "are",
                                     others_ == 1 ? "" : "s", others_ == 1 ? "s" : ""));
        }
        warn_of_kept();
    }

    /// Makes the paths lead from the folder of the output.
    void put_paths() {
        const std::filesystem::path own = std::filesystem::absolute(file_).parent_path().lexically_normal();
        if (what_.folder.empty() || what_.folder.lexically_normal() == own) {
            return;
        }
        const std::filesystem::path seen = path_seen_from(what_.folder, own / "file");
        move_paths(editor_, *root_, seen.parent_path().empty() ? "." : seen.parent_path().generic_string());
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

    /// Returns what the last <compiler> that states an attribute says; empty if none does.
    std::string stated_of_compiler(const char* attribute) const {
        std::string stated;
        for (const xml::Element* compiler : root_->children_named("compiler")) {
            stated = compiler->attribute(attribute) ? *compiler->attribute(attribute) : stated;
        }
        return stated;
    }

    /// Returns the attributes that a mesh of foam states where the classes say something else.
    static std::string mesh_settings(const xml::Element& root) {
        std::string text;
        for (const xml::Element* defaults : root.children_named("default")) {
            const xml::Element* mesh = defaults->child("mesh");
            text = mesh && mesh->attribute("scale") ? attribute_text("scale", "1 1 1") : text;
        }
        return text;
    }

    /// Returns the text to edit. One that is no MJCF stays as it is, for the constructor to refuse.
    static std::string text_of(const TextFile& into) {
        return into.text.find("<include") == into.text.npos ? into.text : with_included(into);
    }

    const xml::Element& body_of(const std::string& link) const {
        const auto found = bodies_.find(link);
        if (found != bodies_.end()) {
            return *found->second;
        }
        const xml::Element* copier = copier_below(*root_);
        if (copier) {
            throw Error(ErrorCode::input,
                        fmt::format("{}:{}: there is no body '{}' in the text: <{}> makes it; remedy: let MuJoCo write "
                                    "the bodies out, by mujoco.mj_saveLastXML(), or skip the link",
                                    file_, copier->line, shown(link), copier->name));
        }
        std::vector<std::string> names;
        for (const auto& [name, body] : bodies_) {
            names.push_back(name);
        }
        const std::string near = nearest_word(link, names);
        throw Error(ErrorCode::input,
                    fmt::format("{}: there is no body '{}' for the link of that name{}; remedy: "
                                "rename the body, or leave the link out",
                                file_, shown(link), near.empty() ? "" : fmt::format(" (there is '{}')", shown(near))));
    }

    /// Returns the first element that makes bodies which are not in the text; nullptr if there is none.
    static const xml::Element* copier_below(const xml::Element& element) {
        for (const auto& child : element.children) {
            const xml::Element* found =
                child->name == "replicate" || child->name == "attach" ? child.get() : copier_below(*child);
            if (found) {
                return found;
            }
        }
        return nullptr;
    }

    /// Returns the geoms of a body that the elements replace; last those that touch in a <pair> alone.
    std::vector<const MjcfGeom*> replaced_in(const std::string& link) {
        std::vector<const MjcfGeom*> old;
        for (auto [it, end] = bodies_.equal_range(link); it != end; ++it) {
            for (const MjcfGeom& geom : geoms_[it->second]) {
                if (geom.collides() && !geom.is_ground() && (geom.sphere() || what_.all_collision)) {
                    old.push_back(&geom);
                } else if (geom.collides() && !geom.is_ground()) {
                    ++others_;
                }
            }
        }
        std::ranges::stable_partition(old, [](const MjcfGeom* geom) { return geom->has_contact(); });
        return old;
    }

    void put(const LinkSpheres& link, const xml::Element& body) {
        const std::vector<const MjcfGeom*> old = replaced_in(link.link);
        const std::vector<std::string> names = names_of(old, link.elements.size());
        const bool renamed = name_to_keep(old, link.elements.size()) != nullptr;
        const std::string settings = settings_of(old, link.link);
        std::vector<std::string> geoms;
        const auto begin = [&, taken = class_of(old)] {
            const std::string& name = names[geoms.size()];
            return "<geom" + (name.empty() ? "" : attribute_text("name", name)) + taken;
        };
        for (const Sphere& s : link.elements.spheres()) {
            geoms.push_back(begin() + attribute_text("type", "sphere") + settings +
                            attribute_text("pos", vector_text(s.center)) +
                            attribute_text("size", numbers_text({&s.radius, 1})) + "/>");
        }
        for (const Element& element : link.elements.shaped()) {
            const std::string shape = shapes_.attributes(element);
            const bool turned = std::ranges::any_of(old, [](const MjcfGeom* geom) { return geom->text("quat"); });
            geoms.push_back(begin() + settings + shape +
                            (turned && shape.find(" quat=") == shape.npos ? attribute_text("quat", "1 0 0 0") : "") +
                            "/>");
        }
        put(geoms, old, body, renamed);
    }

    /// Puts new geoms in place of old ones. `renamed`: they take the name.
    void put(const std::vector<std::string>& geoms, const std::vector<const MjcfGeom*>& old, const xml::Element& body,
             bool renamed) {
        std::vector<const xml::Element*> removed;
        const xml::Element* kept = nullptr;
        for (const MjcfGeom* geom : old) {
            const bool own = geom->frames.empty() && geom->body == &body;
            if (stays(*geom, renamed)) {
                kept = own && !kept ? geom->geom : kept;
                continue;
            }
            replaced_.insert(geom->geom);
            if (own) {
                removed.push_back(geom->geom);
            } else {
                editor_.remove(*geom->geom);
            }
        }
        if (removed.empty() && kept) {
            const std::string separator = separator_before(*kept);
            std::string text;
            for (const std::string& geom : geoms) {
                text += separator + geom;
            }
            editor_.replace({kept->span.end, kept->span.end}, text);
        } else {
            editor_.replace_children(body, removed, geoms);
        }
        for (const MjcfGeom* geom : old) {
            if (!replaced_.contains(geom->geom)) {
                switch_off(*geom, renamed);
            }
        }
    }

    /// Returns the line end and the blanks before an element; nothing if it has no line of its own.
    std::string separator_before(const xml::Element& element) const {
        const std::size_t line = text_.find_last_not_of(" \t", element.span.begin - 1);
        if (line == text_.npos || text_[line] != '\n') {
            return "";
        }
        const std::size_t begin = line > 0 && text_[line - 1] == '\r' ? line - 1 : line;
        return text_.substr(begin, element.span.begin - begin);
    }

    /// Returns whether MuJoCo makes the mass of the geom's body of it.
    bool weighs(const MjcfGeom& geom) const {
        const auto is_zero = [&](const char* attribute) {
            const std::string* text = geom.text(attribute);
            return text && parse_number(*text) == 0.0;
        };
        if (geom.body->name == "worldbody" || inertia_from_geoms_ == "false" ||
            (inertia_from_geoms_ != "true" && geom.body->child("inertial"))) {
            return false;
        }
        return geom.text("mass") ? !is_zero("mass") : !is_zero("density");
    }

    /// Returns whether the geom stays, without contact: for the mass of its body, for the forces of a fluid, or for
    /// those that name it.
    bool stays(const MjcfGeom& geom, bool renamed) const {
        const std::string* name = geom.geom->attribute("name");
        return weighs(geom) || geom.text("fluidshape") || (name && !renamed && used_.contains(*name));
    }

    /// Takes the contact of a geom that stays.
    void switch_off(const MjcfGeom& geom, bool renamed) {
        for (const char* attribute : {"contype", "conaffinity"}) {
            const std::string* text = geom.text(attribute);
            if (!text || *text != "0") {
                editor_.set_attribute(*geom.geom, attribute, "0");
            }
        }
        const std::string* name = geom.geom->attribute("name");
        if (name && renamed) { // after what is put before the first attribute
            const xml::Span value = geom.geom->attribute_span("name", text_);
            const std::size_t key = text_.rfind("name", value.begin - 1);
            const std::size_t begin = text_.find_last_not_of(" \t\r\n", key - 1) + 1;
            editor_.replace({begin, value.end + 1}, "");
        } else if (name && used_.contains(*name)) {
            measured_.push_back(shown(*name));
        }
    }

    void warn_of_kept() const {
        if (!measured_.empty()) {
            context_.log(Severity::warning,
                         fmt::format("{}: sensors, tendons or tuples name geoms that are replaced by several; these "
                                     "stay without contact, and are what they still refer to: {}",
                                     file_, fmt::join(measured_, ", ")));
        }
    }

    /// Returns ` class=…` of the first geom, or the class that holds where it stands, if that is in a frame.
    static std::string class_of(const std::vector<const MjcfGeom*>& old) {
        if (old.empty()) {
            return "";
        }
        const MjcfGeom& first = *old.front();
        const std::string* own = first.geom->attribute("class");
        return own                                                 ? attribute_text("class", *own)
               : !first.frames.empty() && !first.inherited.empty() ? attribute_text("class", first.inherited)
                                                                   : "";
    }

    /// Returns the attributes of new geoms that are not their shape: those that the first old one states itself. They
    /// weigh nothing.
    std::string settings_of(const std::vector<const MjcfGeom*>& old, const std::string& link) const {
        static constexpr std::array taken{"contype", "conaffinity", "condim", "group", "priority", "friction", "solmix",
                                          "solref",  "solimp",      "margin", "gap",   "material", "rgba"};
        static constexpr std::size_t seen_only = 2; // the last ones have no effect on contacts
        std::string text;
        std::set<std::string> differing;
        for (std::size_t i = 0; i < taken.size() && !old.empty(); ++i) {
            const std::string* value = old.front()->geom->attribute(taken[i]);
            text += value ? attribute_text(taken[i], *value) : "";
            for (const MjcfGeom* geom : old) {
                const std::string *first = old.front()->text(taken[i]), *other = geom->text(taken[i]);
                if (i + seen_only < taken.size() && (first ? *first : "") != (other ? *other : "")) {
                    differing.insert(taken[i]);
                }
            }
        }
        if (!differing.empty()) {
            context_.log(Severity::warning,
                         fmt::format("{}:{}: the geoms of '{}' differ in {}; the new ones take what the first has",
                                     file_, old.front()->geom->line, shown(link), fmt::join(differing, ", ")));
        }
        return (old.empty() ? R"( group="3" contype="1" conaffinity="1")" : text) + attribute_text("mass", "0");
    }

    static const std::string* name_of(const MjcfGeom* geom) { return geom->geom->attribute("name"); }

    /// Returns the name that a new geom takes: that of the only old one, which it alone replaces. Null: none.
    static const std::string* name_to_keep(const std::vector<const MjcfGeom*>& old, std::size_t count) {
        return old.size() == 1 && count == 1 && !old.front()->replicated ? name_of(old.front()) : nullptr;
    }

    /// Returns the names of new geoms. Where one replaces one, it takes the name, so that what names it finds it. Where
    /// a <pair> names an old one, each has a name of its own. Others have none.
    std::vector<std::string> names_of(const std::vector<const MjcfGeom*>& old, std::size_t count) {
        if (const std::string* kept = name_to_keep(old, count)) {
            return {*kept};
        }
        std::vector<std::string> names(count);
        const auto in_pair = std::ranges::find_if(old, [&](const MjcfGeom* geom) {
            return name_of(geom) && in_pairs_.contains(*name_of(geom));
        });
        if (in_pair != old.end()) {
            names = new_names(*name_of(*in_pair), count, old);
        }
        for (const MjcfGeom* geom : old) {
            if (name_of(geom)) {
                lost_[*name_of(geom)] = {names, old.size() > 1};
            }
        }
        return names;
    }

    /// Returns NAME_1, NAME_2, …, without those of other geoms.
    std::vector<std::string> new_names(const std::string& name, std::size_t count,
                                       const std::vector<const MjcfGeom*>& old) {
        for (const MjcfGeom* geom : old) {
            const std::string* own = geom->geom->attribute("name");
            if (own && !stays(*geom, false)) {
                names_.erase(*own);
            }
        }
        const std::size_t end = name.find_last_not_of("0123456789");
        const bool numbered = end != name.npos && end > 0 && end + 1 < name.size() && name[end] == '_';
        const std::string stem = numbered ? name.substr(0, end) : name; // the second time names stay as they are
        std::vector<std::string> names;
        for (std::size_t number = 1; names.size() < count; ++number) {
            const std::string next = fmt::format("{}_{}", stem, number);
            if (names_.insert(next).second) {
                names.push_back(next);
            }
        }
        return names;
    }

    /// Adds the names of geoms that sensors, tendons and tuples state. All use these few attributes.
    void add_uses(const xml::Element& element) {
        const auto add = [&](const char* attribute, const char* type) {
            const std::string *name = element.attribute(attribute), *of = type ? element.attribute(type) : nullptr;
            const bool of_contact = element.name == "pair" || element.name == "contact";
            if (name && !of_contact && (!type || (of && *of == "geom"))) {
                used_.insert(*name);
            }
        };
        add("geom", nullptr);
        add("geom1", nullptr);
        add("geom2", nullptr);
        add("objname", "objtype");
        add("refname", "reftype");
        for (const auto& child : element.children) {
            add_uses(*child);
        }
    }

    std::string file_;
    const MjcfReplacement& what_;
    Context& context_;
    std::string text_; ///< with the files that have to be in it
    std::unique_ptr<const xml::Element> root_;
    xml::Editor editor_;
    MjcfShapes shapes_;
    std::string inertia_from_geoms_; ///< what <compiler> says of it
    std::multimap<std::string, const xml::Element*> bodies_;
    std::map<const xml::Element*, std::vector<MjcfGeom>> geoms_;
    std::size_t others_ = 0;
    std::set<std::string> used_;             ///< names of geoms that sensors, tendons and tuples state
    std::vector<std::string> measured_;      ///< those that stay for them
    std::set<const xml::Element*> replaced_; ///< geoms
    std::set<std::string> in_pairs_;         ///< names of geoms that a <pair> states
    std::set<std::string> names_;            ///< of all geoms
    ReplacedGeoms lost_;
};

} // namespace

std::string with_spheres(const TextFile& into, const std::vector<LinkSpheres>& links, const MjcfReplacement& what,
                         Context& context) {
    MjcfEdit edit(into, what, context);
    edit.put(links);
    edit.put_meshes();
    edit.put_pairs();
    edit.put_paths();
    return edit.result();
}

std::string exclude_text(const IgnoredPair& pair) {
    return "<exclude" + attribute_text("body1", pair.first) + attribute_text("body2", pair.second) + "/>";
}

} // namespace foam::xml_models
