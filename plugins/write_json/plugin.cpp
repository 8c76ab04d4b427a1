// write.json: sphere models as JSON.
#include <foam/sdk/plugin.hpp>

#include "layout.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/base/error.hpp>
#include <foam/base/text.hpp>
#include <foam/sdk/elements.hpp>
#include <foam/sdk/kinds.hpp>

#include <algorithm>

namespace foam {

// The database layout of CoMMALab/foam (Coumar et al. 2025), for programs that read it. It has three figures of a tree
// level: mean, best and worst distance from a sphere to the mesh. Here only those of the finest level are known (mean
// and largest protrusion); the others are null. A link and mesh that occur several times get "#2", "#3"… after the
// mesh, where CoMMALab/foam lost all but one.

namespace {

std::string depth_object(const SphereGroup& group, std::size_t depth, const std::string& more,
                         const std::string& indent) {
    std::vector<std::string> spheres;
    CancellationCounter asking(1024);
    for (const Sphere& s : group.tree.levels[depth].elements.spheres()) { // all there is: require_spheres()
        asking.check();
        spheres.push_back(
            fmt::format("{}  {{\"origin\": {}, \"radius\": {}}}", indent, json_point(s.center), number_text(s.radius)));
    }
    const bool finest = depth + 1 == group.tree.levels.size();
    return fmt::format("{{{}\"mean\": {}, \"best\": null, \"worst\": {}, \"spheres\": [\n{}\n{}]}}", more,
                       finest ? json_number(group.measures.protrusion_mean) : "null",
                       finest ? json_number(group.measures.protrusion_max) : "null", fmt::join(spheres, ",\n"), indent);
}

/// Returns the largest number of children of a sphere.
std::size_t branch_of(const SphereTree& tree) {
    std::size_t branch = 1;
    for (const SphereTree::Level& level : tree.levels) {
        std::map<std::uint32_t, std::size_t> children;
        for (const std::uint32_t parent : level.parents) {
            branch = std::max(branch, ++children[parent]);
        }
    }
    return branch;
}

std::string geometry_of(const SphereGroup& group) {
    return fmt::format("{}", fmt::join(group.geometries, "+"));
}

} // namespace

void require_spheres(const SphereModel& model) {
    require_writable(model);
    for (const SphereGroup& group : model.groups) {
        for (const SphereTree::Level& level : group.tree.levels) {
            if (!level.elements.are_spheres()) {
                throw Error(ErrorCode::output,
                            fmt::format("link '{}' has {}, and the layouts of CoMMALab/foam hold spheres only; "
                                        "remedy: layout: links",
                                        group.link, with_article(noun_of(level.elements.shaped().front().kind, 1))));
            }
        }
    }
}

std::string write_original_layout(const SphereModel& model) {
    require_spheres(model);
    std::map<std::string, int> uses;
    std::vector<std::string> members;
    for (const SphereGroup& group : model.groups) {
        std::string key = group.link + "::" + geometry_of(group);
        if (const int use = ++uses[key]; use > 1) {
            key += fmt::format("#{}", use);
        }
        std::vector<std::string> depths;
        for (std::size_t depth = 0; depth < group.tree.levels.size(); ++depth) {
            depths.push_back(fmt::format("      \"{}\": {}", depth, depth_object(group, depth, "", "      ")));
        }
        members.push_back(fmt::format("  {}: {{\n    \"{}\": {{\n{}\n    }}\n  }}", json_text(key),
                                      branch_of(group.tree), fmt::join(depths, ",\n")));
    }
    return fmt::format("{{\n{}\n}}\n", fmt::join(members, ",\n"));
}

std::string write_original_mesh_layout(const SphereModel& model) {
    require_spheres(model);
    if (model.groups.size() != 1) {
        throw Error(
            ErrorCode::output,
            fmt::format("layout: foam_mesh holds one mesh, and the model has {} groups of spheres; use layout: foam",
                        model.groups.size()));
    }
    const SphereGroup& group = model.groups.front();
    std::vector<std::string> depths;
    for (std::size_t depth = 0; depth < group.tree.levels.size(); ++depth) {
        depths.push_back("  " + depth_object(group, depth, fmt::format("\"link\": {}, ", json_text(group.link)), "  "));
    }
    return fmt::format("[\n{}\n]\n", fmt::join(depths, ",\n"));
}

ElementsByLink read_original_layout(const Json& document) {
    ElementsByLink result;
    const auto add = [&](const std::string& link, const Json& spheres) {
        for (const Json& s : spheres) {
            const Json& origin = s.at("origin");
            result[link].spheres().push_back(
                {{origin.at(0).get<double>(), origin.at(1).get<double>(), origin.at(2).get<double>()},
                 s.at("radius").get<double>()});
        }
    };
    if (document.is_array()) {
        add(document.back().at("link").get<std::string>(), document.back().at("spheres"));
        return result;
    }
    for (const auto& [key, branches] : document.items()) {
        const Json& depths = branches.begin().value();
        // Keys are texts: "10" comes before "9".
        const std::string finest = std::to_string(depths.size() - 1);
        add(key.substr(0, key.rfind("::")), depths.at(finest).at("spheres"));
    }
    return result;
}

namespace {

class JsonWriter final : public Writer {
public:
    explicit JsonWriter(const Parameters& parameters) : layout_(parameters.text("layout")) {}

    std::string write(const SphereModel& model, Context&) const override {
        return layout_ == "links"  ? write_links_layout(model)
               : layout_ == "foam" ? write_original_layout(model)
                                   : write_original_mesh_layout(model);
    }

    std::map<std::string, Elements>
    read(const std::string& bytes, const std::map<std::string, std::string>&) const override {
        try {
            const Json document = Json::parse(bytes);
            return layout_ == "links" ? read_links_layout(document) : read_original_layout(document);
        } catch (const Json::exception& error) {
            throw Error(ErrorCode::output, fmt::format("JSON: {}", error.what()));
        } catch (const Error& error) {
            throw Error(ErrorCode::output, error.what());
        }
    }

private:
    std::string layout_;
};

} // namespace

} // namespace foam

FOAM_PLUGIN("write_json", "1.0", "Apache-2.0") {
    using foam::Parameter;
    enrol.add<foam::JsonWriter>(
        {.name = "write.json",
         .summary = "Writes the sphere trees, other elements and measures of all links as JSON.",
         .reference = "schemas/spheres.schema.json; layout foam: Coumar et al. 2025",
         .parameters = {Parameter::choice("layout", {"links", "foam", "foam_mesh"}, "links")
                            .doc("links: schemas/spheres.schema.json; foam: the database of CoMMALab/foam, by link and "
                                 "mesh; foam_mesh: the same of a single mesh.")
                            .source("links is the one layout that holds all of a model.")},
         .extensions = {"json"},
         .kinds = foam::every_kind()});
}
