// Spheres as a glTF file to look at: write.gltf and read.gltf.
#include <foam/sdk/plugin.hpp>

#include "picture.hpp"

#include <foam/base/error.hpp>
#include <foam/base/text.hpp>
#include <foam/sdk/elements.hpp>
#include <foam/yaml/value.hpp>

#include <fmt/format.h>

#include <cmath>
#include <optional>

namespace foam::gltf {
namespace {

using yaml::Value;
using Kind = Value::Kind;

constexpr yaml::TextKind gltf_file{.name = "glTF file", .most_bytes = 64'000'000};

/// Reads spheres of nodes.
class NodeReader {
public:
    explicit NodeReader(const std::filesystem::path& file)
        : result{.file = file, .format = "glTF", .links = {}, .fixed_joints = {}, .notes = {}} {}

    void read(const Value& root) {
        const Value& nodes = list(root.find("nodes"), root, "nodes");
        for (const Value& node : nodes.items) {
            if (const Value* children = node.find("children")) {
                read_link(node, list(children, node, "children"), nodes);
            }
        }
        if (result.links.empty()) {
            fail(nodes,
                 "no node has a child with extras.radius or extras.element; remedy: only files of write.gltf are read");
        }
    }

    SphereFile result;

private:
    [[noreturn]] void fail(const Value& at, const std::string& why) const {
        throw Error(ErrorCode::input,
                    fmt::format("{}:{}:{}: {}", result.file.string(), at.where.line, at.where.column, shown(why)));
    }

    const Value& list(const Value* value, const Value& holder, const std::string& key) const {
        if (!value || !value->is(Kind::list)) {
            fail(value ? *value : holder, fmt::format("expected a list '{}'", key));
        }
        return *value;
    }

    double number(const Value& value) const {
        const bool is_whole = value.is(Kind::integer);
        const double number = is_whole ? static_cast<double>(value.whole) : value.real;
        if ((!is_whole && !value.is(Kind::number)) || !std::isfinite(number)) {
            fail(value, "expected a finite number, got " + value.description());
        }
        return number;
    }

    const Value& child_of(const Value& number, const Value& nodes) const {
        if (!number.is(Kind::integer) || number.whole < 0 ||
            static_cast<std::size_t>(number.whole) >= nodes.items.size()) {
            fail(number, fmt::format("expected the number of a node, 0 to {}, got {}", nodes.items.size() - 1,
                                     number.description()));
        }
        return nodes.items[static_cast<std::size_t>(number.whole)];
    }

    void read_link(const Value& node, const Value& children, const Value& nodes) {
        Elements elements;
        for (const Value& number : children.items) {
            const Value& child = child_of(number, nodes);
            const Value* extras = child.find("extras");
            const Value* radius = extras ? extras->find("radius") : nullptr;
            const Value* element = extras ? extras->find("element") : nullptr;
            if (radius) {
                elements.add(Sphere{translation(child), this->number(*radius)});
            } else if (element && element->is(Kind::map)) {
                elements.add(read_element(*element));
            }
        }
        if (elements.size() > 0) {
            const Value* name = node.find("name");
            link_of(result, name ? name->text : "").elements.add(elements);
        }
    }

    Element read_element(const Value& value) const {
        std::string kind;
        ElementNumbers numbers;
        for (std::size_t i = 0; i < value.keys.size(); ++i) {
            if (value.keys[i].text == "kind") {
                kind = value.items[i].text;
                continue;
            }
            std::vector<double>& values = numbers.emplace_back(value.keys[i].text, std::vector<double>{}).second;
            for (const Value& item : list(&value.items[i], value, value.keys[i].text).items) {
                values.push_back(number(item));
            }
        }
        try {
            return element_of(kind, numbers);
        } catch (const Error& error) {
            fail(value, error.what());
        }
    }

    Vec3 translation(const Value& node) const {
        const Value* value = node.find("translation");
        if (!value) {
            return {};
        }
        const Value& numbers = list(value, node, "translation");
        if (numbers.items.size() != 3) {
            fail(numbers, fmt::format("expected three numbers, got {}", numbers.items.size()));
        }
        return {number(numbers.items[0]), number(numbers.items[1]), number(numbers.items[2])};
    }
};

} // namespace

bool is_picture(std::string_view text) {
    if (!text.starts_with('{')) {
        return false;
    }
    text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n", 1), text.size()));
    return text.starts_with("\"asset\"") && text.find("\"nodes\"") != text.npos &&
           text.find("\"extras\"") != text.npos &&
           (text.find("\"radius\"") != text.npos || text.find("\"element\"") != text.npos);
}

SphereFile read_picture(const std::string& text, const std::filesystem::path& file) {
    NodeReader reader(file);
    reader.read(yaml::tree_of(text, file.string(), gltf_file));
    return std::move(reader.result);
}

namespace {

class GltfWriter final : public Writer {
public:
    std::string write(const SphereModel& model, Context&) const override { return picture_text(model); }

    std::map<std::string, Elements>
    read(const std::string& bytes, const std::map<std::string, std::string>&) const override {
        try {
            return elements_of(read_picture(bytes, "glTF"));
        } catch (const Error& error) {
            throw Error(ErrorCode::output, error.what());
        }
    }
};

class GltfReader final : public ModelReader {
public:
    bool recognises(std::string_view text) const override { return is_picture(text); }

    SphereFile read(const std::string& text, const std::filesystem::path& file, Context&) const override {
        return read_picture(text, file);
    }
};

} // namespace

} // namespace foam::gltf

FOAM_PLUGIN("write_gltf", "1.0", "Apache-2.0") {
    using namespace foam::gltf;
    const std::string reference = "https://registry.khronos.org/glTF/specs/2.0/glTF-2.0.html";
    enrol.add<GltfWriter>(
        {.name = "write.gltf",
         .summary = "Writes a glTF file to look at: the links at the robot's default pose, y up; pictures only.",
         .reference = reference,
         .extensions = {"gltf"},
         .kinds = foam::every_kind(),
         .consumer = {.name = "glTF 2.0", .rest_pose = true}});
    enrol.add<GltfReader>({.name = "read.gltf",
                           .summary = "Reads the file of write.gltf: elements by link, from extras of nodes.",
                           .reference = reference,
                           .extensions = {"gltf"}});
}
