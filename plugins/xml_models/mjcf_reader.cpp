// The spheres of MJCF: geoms of bodies. A geom without type is a sphere, unless its class or a mesh says otherwise.
#include "attributes.hpp"
#include "mjcf.hpp"

#include <foam/base/error.hpp>

#include <fmt/format.h>

#include <set>

namespace foam::xml_models {
namespace {

class Reading {
public:
    Reading(SphereFile& result, const xml::Element& root) : result_(result), file_(result.file.string()) {
        if (const xml::Element* defaults = root.child("default")) {
            add_classes(*defaults, nullptr, true);
        }
        for (const xml::Element* world : root.children_named("worldbody")) {
            read_body(*world, "");
        }
        if (others_ > 0) {
            result.notes.push_back(fmt::format("{} geom{} no sphere{} and left out", others_,
                                               others_ == 1 ? " is" : "s are", others_ == 1 ? "" : "s"));
        }
    }

private:
    /// The attributes of the <geom> of a class, those of its parent class included.
    struct Class {
        std::string type = "sphere";
        const std::string* size = nullptr;
        const xml::Element* geom = nullptr; ///< the one that has the size
    };

    void add_classes(const xml::Element& element, const Class* parent, bool top) {
        Class own = parent ? *parent : Class{};
        if (const xml::Element* geom = element.child("geom")) {
            if (const std::string* type = geom->attribute("type")) {
                own.type = *type;
            }
            if (const std::string* size = geom->attribute("size")) {
                own.size = size;
                own.geom = geom;
            }
        }
        const std::string* name = element.attribute("class");
        classes_[name ? *name : top ? "main" : ""] = own;
        if (top) {
            classes_[""] = own;
        }
        for (const xml::Element* child : element.children_named("default")) {
            add_classes(*child, &own, false);
        }
    }

    const Class& class_of(const xml::Element& geom, const std::string& inherited) {
        const std::string* name = geom.attribute("class");
        const auto found = classes_.find(name ? *name : inherited);
        if (found == classes_.end() && !(name ? *name : inherited).empty()) {
            throw Error(ErrorCode::input, fmt::format("{}:{}: there is no default class '{}'", file_, geom.line,
                                                      name ? *name : inherited));
        }
        return found == classes_.end() ? plain_ : found->second;
    }

    void read_body(const xml::Element& body, const std::string& inherited) {
        const std::string* childclass = body.attribute("childclass");
        const std::string& own = childclass ? *childclass : inherited;
        for (const auto& child : body.children) {
            if (child->name == "geom") {
                read_geom(*child, body, own);
            } else if (child->name == "body") {
                read_body(*child, own);
            }
        }
    }

    void read_geom(const xml::Element& geom, const xml::Element& body, const std::string& inherited) {
        const Class& defaults = class_of(geom, inherited);
        const std::string* type = geom.attribute("type");
        if ((type ? *type : defaults.type) != "sphere" || geom.attribute("mesh")) {
            ++others_;
            return;
        }
        const xml::Element* sized = geom.attribute("size") ? &geom : defaults.geom;
        if (!sized) {
            throw Error(ErrorCode::input, fmt::format("{}:{}: the sphere has no size", file_, geom.line));
        }
        Vec3 center;
        if (geom.attribute("pos")) {
            const std::vector<double> pos = numbers_of(geom, "pos", 3, file_);
            center = {pos[0], pos[1], pos[2]};
        }
        const std::string* name = body.attribute("name");
        spheres_of(result_, name                       ? *name
                            : body.name == "worldbody" ? "world"
                                                       : "")
            .push_back({center, numbers_of(*sized, "size", 0, file_).front()});
    }

    SphereFile& result_;
    std::string file_;
    std::map<std::string, Class> classes_;
    Class plain_;
    std::size_t others_ = 0;
};

} // namespace

bool MjcfReader::recognises(std::string_view text) const {
    return xml::root_name(text) == "mujoco";
}

SphereFile MjcfReader::read(const std::string& text, const std::filesystem::path& file, Context&) const {
    const auto root = xml::parse(text, file.string(), ErrorCode::input);
    SphereFile result;
    result.file = file;
    result.format = "MJCF";
    if (root->name != "mujoco") {
        throw Error(ErrorCode::input,
                    fmt::format("{}:{}: <{}> is not <mujoco>", file.string(), root->line, root->name));
    }
    Reading(result, *root);
    return result;
}

} // namespace foam::xml_models
