// The <pair> of an MJCF whose geoms are replaced by others, and the sensors that must not lose theirs.
#include "mjcf.hpp"

#include <foam/base/error.hpp>
#include <foam/base/text.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace foam::xml_models {
namespace {

/// Returns the text of a pair of other geoms. `first`: of those that replace one pair; it alone keeps the name.
std::string pair_of(const xml::Element& pair, const std::string& geom1, const std::string& geom2, bool first) {
    std::string text = "<pair";
    for (const auto& [key, value] : pair.attributes) {
        if (key != "name" || first) {
            text += attribute_text(key, key == "geom1" ? geom1 : key == "geom2" ? geom2 : value);
        }
    }
    return text + "/>";
}

class Pairs {
public:
    Pairs(const ReplacedGeoms& replaced, const std::string& file, Context& context)
        : replaced_(replaced), file_(file), context_(context) {}

    void edit(xml::Editor& editor, const xml::Element& contact) {
        for (const xml::Element* pair : contact.children_named("pair")) {
            const std::string *geom1 = pair->attribute("geom1"), *geom2 = pair->attribute("geom2");
            if (!geom1 || !geom2 || (!replaced_.contains(*geom1) && !replaced_.contains(*geom2))) {
                continue;
            }
            std::vector<std::string> lines;
            for (const std::string& first : names_for(*geom1)) {
                for (const std::string& second : names_for(*geom2)) {
                    if (written_.insert(std::minmax(first, second)).second) { // MuJoCo refuses a pair that is repeated
                        lines.push_back(pair_of(*pair, first, second, lines.empty()));
                    }
                }
            }
            lines.empty() ? editor.remove(*pair) : editor.replace_children(contact, {pair}, lines);
            say(*pair, lines.size());
        }
    }

private:
    /// Returns the names of the geoms that have the place of one.
    std::vector<std::string> names_for(const std::string& name) const {
        const auto found = replaced_.find(name);
        return found == replaced_.end() ? std::vector{name} : found->second.names;
    }

    void say(const xml::Element& pair, std::size_t count) {
        const auto others_too = [&](const char* attribute) {
            const auto found = replaced_.find(*pair.attribute(attribute));
            return found != replaced_.end() && found->second.with_others;
        };
        const bool wider = others_too("geom1") || others_too("geom2");
        context_.log(wider || count == 0 ? Severity::warning : Severity::info,
                     fmt::format("{}:{}: <pair> becomes {} pair{}, of the geoms that replace those it names{}", file_,
                                 pair.line, count, count == 1 ? "" : "s",
                                 wider ? "; they also replace other geoms of the body, for which it holds now" : ""));
    }

    const ReplacedGeoms& replaced_;
    const std::string& file_;
    Context& context_;
    std::set<std::pair<std::string, std::string>> written_;
};

} // namespace

std::set<std::string> names_in_pairs(const xml::Element& root) {
    std::set<std::string> names;
    for (const xml::Element* contact : root.children_named("contact")) {
        for (const xml::Element* pair : contact->children_named("pair")) {
            for (const char* key : {"geom1", "geom2"}) {
                if (const std::string* name = pair->attribute(key)) {
                    names.insert(*name);
                }
            }
        }
    }
    return names;
}

void put_pairs_of_replaced(xml::Editor& editor, const xml::Element& root, const ReplacedGeoms& replaced,
                           const std::string& file, Context& context) {
    for (const xml::Element* sensor : root.children_named("sensor")) {
        for (const xml::Element* contact : sensor->children_named("contact")) {
            for (const char* attribute : {"geom1", "geom2"}) {
                const std::string* name = contact->attribute(attribute);
                if (name && replaced.contains(*name)) {
                    throw Error(ErrorCode::input,
                                fmt::format("{}:{}: <contact {}=\"{}\"> senses the contacts of a geom that others "
                                            "replace; remedy: let it name the body, by {}, skip the link, or allow one "
                                            "element for it",
                                            file, contact->line, attribute, shown(*name),
                                            attribute == std::string_view("geom1") ? "body1" : "body2"));
                }
            }
        }
    }
    Pairs pairs(replaced, file, context);
    for (const xml::Element* contact : root.children_named("contact")) {
        pairs.edit(editor, *contact);
    }
}

} // namespace foam::xml_models
