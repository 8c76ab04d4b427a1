#include "mjcf_geoms.hpp"

#include <foam/base/error.hpp>

#include <fmt/format.h>

#include <map>

namespace foam::xml_models {
namespace {

/// The elements that state the attributes of the <geom> of a class, those of its parent class included.
using GeomClass = std::map<std::string, const xml::Element*, std::less<>>;

void take(GeomClass& attributes, const xml::Element& geom) {
    for (const auto& [key, value] : geom.attributes) {
        attributes[key] = &geom;
    }
}

class GeomWalk {
public:
    GeomWalk(const xml::Element& root, const std::string& file) : file_(file) {
        if (const xml::Element* defaults = root.child("default")) {
            add_classes(*defaults, {}, true);
        }
        for (const xml::Element* world : root.children_named("worldbody")) {
            walk(*world, "");
        }
    }

    std::vector<MjcfGeom> geoms;

private:
    void add_classes(const xml::Element& element, GeomClass own, bool top) {
        if (const xml::Element* geom = element.child("geom")) {
            take(own, *geom);
        }
        const std::string* name = element.attribute("class");
        classes_[name ? *name : top ? "main" : ""] = own;
        if (top) {
            classes_[""] = own;
        }
        for (const xml::Element* child : element.children_named("default")) {
            add_classes(*child, own, false);
        }
    }

    GeomClass class_of(const xml::Element& geom, const std::string& inherited) const {
        const std::string* name = geom.attribute("class");
        const std::string& wanted = name ? *name : inherited;
        const auto found = classes_.find(wanted);
        if (found == classes_.end() && !wanted.empty()) {
            throw Error(ErrorCode::input,
                        fmt::format("{}:{}: there is no default class '{}'", file_, geom.line, wanted));
        }
        return found == classes_.end() ? GeomClass{} : found->second;
    }

    void walk(const xml::Element& body, const std::string& inherited) {
        const std::string* childclass = body.attribute("childclass");
        const std::string& own = childclass ? *childclass : inherited;
        for (const auto& child : body.children) {
            if (child->name == "geom") {
                GeomClass attributes = class_of(*child, own);
                take(attributes, *child);
                geoms.push_back({child.get(), &body, std::move(attributes)});
            } else if (child->name == "body") {
                walk(*child, own);
            }
        }
    }

    const std::string& file_;
    std::map<std::string, GeomClass> classes_;
};

} // namespace

const std::string* MjcfGeom::text(std::string_view attribute) const {
    const auto found = stated.find(attribute);
    return found == stated.end() ? nullptr : found->second->attribute(attribute);
}

bool MjcfGeom::sphere() const {
    const std::string* type = text("type");
    return (!type || *type == "sphere") && !geom->attribute("mesh");
}

bool MjcfGeom::collides() const {
    const std::string *contype = text("contype"), *conaffinity = text("conaffinity");
    return !contype || *contype != "0" || !conaffinity || *conaffinity != "0";
}

std::vector<MjcfGeom> geoms_of(const xml::Element& root, const std::string& file) {
    return GeomWalk(root, file).geoms;
}

std::string name_of_body(const xml::Element& body) {
    const std::string* name = body.attribute("name");
    return name ? *name : body.name == "worldbody" ? "world" : "";
}

} // namespace foam::xml_models
