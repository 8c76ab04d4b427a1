// Prints what load.urdf reads of the files that standard input names, one a line: as a line of JSON each, with links,
// collision elements, warnings, or the error. robots.py compares it with other readers.
#include <foam/base/error.hpp>
#include <foam/sdk/context.hpp>
#include <foam/sdk/kinds.hpp>
#include <foam/sdk/registry.hpp>
#include <foam/sdk/resource.hpp>
#include <foam/sdk/stage.hpp>

#include <nlohmann/json.hpp>

#include <fstream>
#include <iostream>
#include <iterator>

namespace foam {
namespace {

using nlohmann::json;

class Warnings final : public QuietContext {
public:
    void log(Severity, std::string_view message) override { messages.emplace_back(message); }
    std::vector<std::string> messages;
};

json row(const Vec3& v) {
    return {v.x, v.y, v.z};
}

/// Returns the sizes as a URDF has them: edges of a box, radius and length of what is round.
json sizes_of(const Element& element) {
    switch (element.kind) {
    case Element::Kind::sphere:
        return {element.radius};
    case Element::Kind::cylinder:
    case Element::Kind::capsule:
        return {element.radius, 2 * element.half.z};
    case Element::Kind::box:
        return row(element.half * 2);
    default:
        return row(element.half);
    }
}

json part_of(const GeometryElement& element) {
    const auto* mesh = std::get_if<MeshReference>(&element.geometry);
    json part{{"line", element.line},
              {"xyz", row(element.origin.translation)},
              {"rotation",
               {row(element.origin.rotation[0]), row(element.origin.rotation[1]), row(element.origin.rotation[2])}}};
    if (mesh) {
        part.update({{"kind", "mesh"}, {"sizes", row(mesh->scale)}, {"file", mesh->path.string()}, {"uri", mesh->uri}});
    } else {
        const Element& shape = std::get<Element>(element.geometry);
        part.update({{"kind", to_string(shape.kind)}, {"sizes", sizes_of(shape)}});
    }
    return part;
}

json robot_of(const std::string& file, const RobotLoader& loader) {
    Warnings context;
    json answer{{"file", file}};
    try {
        std::ifstream stream(file, std::ios::binary);
        const std::string text{std::istreambuf_iterator<char>(stream), {}};
        const Robot robot = loader.load(text, file, ResourceResolver::from_environment(), context);
        answer["root"] = robot.root;
        answer["links"] = json::object();
        for (const Link& link : robot.links) {
            json& parts = answer["links"][link.name] = json::array();
            for (const GeometryElement& element : link.collisions) {
                parts.push_back(part_of(element));
            }
        }
    } catch (const std::exception& error) {
        answer["error"] = error.what();
    }
    answer["warnings"] = context.messages;
    return answer;
}

void serve() {
    Registry registry;
    for (const std::filesystem::path& folder : plugin_directories()) {
        registry.load_directory(folder);
    }
    const auto loader = registry.make<RobotLoader>("load.urdf");
    for (std::string file; std::getline(std::cin, file);) {
        std::cout << robot_of(file, *loader).dump(-1, ' ', true, json::error_handler_t::replace) << std::endl;
    }
}

} // namespace
} // namespace foam

int main() {
    try {
        foam::serve();
        return 0;
    } catch (const std::exception& error) {
        std::cerr << "foam-robot-parts: " << error.what() << '\n';
    }
    return 1;
}
