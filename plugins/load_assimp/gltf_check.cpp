// What assimp takes on trust in a glTF 2.0 file: counts, ranges, references, the depth of nesting.
// Names and rules after the Khronos glTF 2.0 specification.
#include "readers.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cstring>
#include <map>

namespace foam::load_assimp {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

constexpr std::size_t deepest = 200; ///< nesting of JSON and of nodes: assimp recurses

/// The JSON text, and the length of the binary chunk of a GLB.
struct Parts {
    std::string_view text;
    std::uint64_t binary = 0;
};

Parts parts_of(const Source& source) {
    const std::string_view bytes = source.bytes;
    if (!bytes.starts_with("glTF")) {
        return {bytes, 0};
    }
    const auto word = [&](std::size_t at) {
        std::uint32_t value = 0;
        if (at + sizeof value > bytes.size()) {
            throw source.error(fmt::format(
                "the GLB ends after {} bytes, inside a header; remedy: export or copy it again", bytes.size()));
        }
        std::memcpy(&value, bytes.data() + at, sizeof value);
        return value;
    };
    if (word(4) != 2) {
        throw source.error(fmt::format("it is glTF {}; remedy: export glTF 2.0", word(4)));
    }
    if (word(8) > bytes.size()) {
        throw source.error(fmt::format(
            "the GLB promises {} bytes, but the file has {}; remedy: export or copy it again", word(8), bytes.size()));
    }
    Parts parts;
    for (std::size_t at = 12; at + 8 <= word(8);) {
        const std::uint64_t length = word(at);
        const std::uint32_t type = word(at + 4);
        if (length > bytes.size() - at - 8) {
            throw source.error(
                fmt::format("a chunk of the GLB promises {} bytes, but {} follow; remedy: export or copy it again",
                            length, bytes.size() - at - 8));
        }
        if (type == 0x4E4F534Au) { // "JSON"
            parts.text = bytes.substr(at + 8, length);
        } else if (type == 0x004E4942u) { // "BIN"
            parts.binary = length;
        }
        at += 8 + length;
    }
    return parts;
}

void check_depth(const Source& source, std::string_view text) {
    std::size_t depth = 0;
    bool quoted_text = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (quoted_text) {
            i += c == '\\' ? 1 : 0;
            quoted_text = c != '"';
        } else if (c == '"') {
            quoted_text = true;
        } else if (c == '{' || c == '[') {
            if (++depth > deepest) {
                throw source.error(fmt::format("its JSON is nested more than {} deep", deepest));
            }
        } else if ((c == '}' || c == ']') && depth > 0) {
            --depth;
        }
    }
}

class GltfCheck {
public:
    GltfCheck(const Source& source, const json& root, std::uint64_t binary, std::size_t max_triangles)
        : source_(source), root_(root), binary_(binary), max_count_(3 * std::uint64_t{max_triangles}) {}

    void run() {
        const json* asset = find(root_, "asset");
        const json* version = asset ? find(*asset, "version") : nullptr;
        if (!version || !version->is_string() || !version->get_ref<const std::string&>().starts_with("2")) {
            throw source_.error("it does not say that it is glTF 2 (asset.version); remedy: export glTF 2.0");
        }
        extensions();
        each("buffers", [&](const json& item, const std::string& name) { buffer(item, name); });
        each("bufferViews", [&](const json& item, const std::string& name) { view(item, name); });
        each("accessors", [&](const json& item, const std::string& name) { accessor(item, name); });
        each("meshes", [&](const json& item, const std::string& name) { mesh(item, name); });
        nodes();
    }

private:
    struct Accessor {
        std::uint64_t count;
        std::string type;
        std::uint64_t component;
    };

    static const json* find(const json& object, const char* key) {
        const auto it = object.is_object() ? object.find(key) : object.end();
        return it == object.end() ? nullptr : &*it;
    }

    [[noreturn]] void fail(const std::string& name, const std::string& what) const {
        throw source_.error(fmt::format("{} {}; remedy: export or copy it again", name, what));
    }

    template <class Body> void each(const char* key, Body body) const {
        const json* list = find(root_, key);
        for (std::size_t i = 0; list && i < list->size(); ++i) {
            const std::string name = fmt::format("{}[{}]", key, i);
            if (!list->is_array() || !(*list)[i].is_object()) {
                fail(name, "is no object");
            }
            body((*list)[i], name);
        }
    }

    std::size_t size_of_list(const char* key) const {
        const json* list = find(root_, key);
        return list && list->is_array() ? list->size() : 0;
    }

    std::uint64_t natural(const json& value, const std::string& name) const {
        if (value.is_number_unsigned()) {
            const auto number = value.get<std::uint64_t>();
            if (number < (std::uint64_t{1} << 48)) {
                return number;
            }
        }
        if (value.is_number_float()) { // some exporters write 12.0
            const double number = value.get<double>();
            if (number >= 0 && number < 0x1p48 && number == std::floor(number)) {
                return static_cast<std::uint64_t>(number);
            }
        }
        fail(name, "is to be a natural number");
    }

    std::uint64_t natural(const json& object, const char* key, const std::string& name,
                          std::optional<std::uint64_t> otherwise) const {
        const json* value = find(object, key);
        if (!value && otherwise) {
            return *otherwise;
        }
        const std::string full = fmt::format("{}.{}", name, key);
        if (!value) {
            fail(full, "is missing");
        }
        return natural(*value, full);
    }

    std::uint64_t reference(const json& value, std::size_t count, const char* list, const std::string& name) const {
        const std::uint64_t index = natural(value, name);
        if (index >= count) {
            fail(name, fmt::format("refers to {}[{}], but there are {}", list, index, count));
        }
        return index;
    }

    void extensions() const {
        const json* required = find(root_, "extensionsRequired");
        for (std::size_t i = 0; required && required->is_array() && i < required->size(); ++i) {
            const json& name = (*required)[i];
            const std::string text = name.is_string() ? name.get<std::string>() : name.dump();
            if (text.find("compression") != text.npos || text == "KHR_mesh_quantization") {
                throw source_.error(
                    fmt::format("it needs the extension {}, which is not read; remedy: export without compression",
                                printable(text)));
            }
        }
    }

    void buffer(const json& item, const std::string& name) {
        const std::uint64_t promised = natural(item, "byteLength", name, std::nullopt);
        const json* uri = find(item, "uri");
        std::uint64_t there = binary_;
        if (uri && uri->is_string()) {
            const auto& text = uri->get_ref<const std::string&>();
            const std::size_t comma = text.find(',');
            if (text.starts_with("data:") && comma != text.npos) {
                there = (text.size() - comma - 1) / 4 * 3 + 3;
            } else {
                const fs::path file = source_.file.parent_path() / text;
                std::error_code error;
                there = fs::file_size(file, error);
                if (error) {
                    throw source_.error(
                        fmt::format("{} is in the file {}, which cannot be read ({}); remedy: copy it beside this file",
                                    name, file.string(), error.message()));
                }
            }
        }
        if (promised > there) {
            fail(name, fmt::format("promises {} bytes, but there are {}", promised, there));
        }
        buffers_.push_back(promised);
    }

    void view(const json& item, const std::string& name) {
        const json* value = find(item, "buffer");
        const std::uint64_t index = value ? reference(*value, buffers_.size(), "buffers", name + ".buffer") : 0;
        const std::uint64_t offset = natural(item, "byteOffset", name, 0),
                            length = natural(item, "byteLength", name, std::nullopt);
        if (!value || offset + length > buffers_[index]) {
            fail(name, fmt::format("ends at byte {} of a buffer of {}", offset + length, value ? buffers_[index] : 0));
        }
        views_.push_back(length);
    }

    /// `count` elements of `size` bytes in the view that `item` names.
    void range(const json& item, std::uint64_t count, std::uint64_t size, const std::string& name) const {
        const json* value = find(item, "bufferView");
        if (!value) {
            return; // all zeros
        }
        const std::uint64_t index = reference(*value, views_.size(), "bufferViews", name + ".bufferView");
        const std::uint64_t stride =
            natural(root_["bufferViews"][index], "byteStride", fmt::format("bufferViews[{}]", index), 0);
        const std::uint64_t step = stride == 0 ? size : stride;
        if (step < size || step > 65536) {
            fail(name, fmt::format("has a byte stride of {} for elements of {} bytes", step, size));
        }
        const std::uint64_t end = natural(item, "byteOffset", name, 0) + (count > 0 ? step * (count - 1) + size : 0);
        if (end > views_[index]) {
            fail(name, fmt::format("needs {} bytes of bufferViews[{}], which has {}", end, index, views_[index]));
        }
    }

    std::uint64_t component_size(std::uint64_t type, const std::string& name) const {
        switch (type) {
        case 5120:
        case 5121:
            return 1;
        case 5122:
        case 5123:
            return 2;
        case 5125:
        case 5126:
            return 4;
        default:
            fail(name, fmt::format("has the unknown component type {}", type));
        }
    }

    void accessor(const json& item, const std::string& name) {
        static const std::map<std::string, std::uint64_t> components{
            {"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT2", 4}, {"MAT3", 9}, {"MAT4", 16}};
        Accessor result{natural(item, "count", name, std::nullopt), "",
                        natural(item, "componentType", name, std::nullopt)};
        if (result.count > max_count_) {
            fail(name, fmt::format("has {} elements, more than {} triangles can use", result.count, max_count_ / 3));
        }
        const json* type = find(item, "type");
        result.type = type && type->is_string() ? type->get<std::string>() : "";
        const auto number = components.find(result.type);
        if (number == components.end()) {
            fail(name, fmt::format("has the unknown type {}", printable(result.type)));
        }
        const std::uint64_t size = number->second * component_size(result.component, name);
        range(item, result.count, size, name);
        if (find(item, "sparse")) { // they serve morph targets; assimp follows their indices unchecked
            throw source_.error(
                fmt::format("{} is sparse, which is not read; remedy: export without sparse accessors", name));
        }
        accessors_.push_back(std::move(result));
    }

    void mesh(const json& item, const std::string& name) const {
        const json* primitives = find(item, "primitives");
        for (std::size_t i = 0; primitives && primitives->is_array() && i < primitives->size(); ++i) {
            const json& primitive = (*primitives)[i];
            const std::string place = fmt::format("{}.primitives[{}]", name, i);
            if (const json* indices = find(primitive, "indices")) {
                const Accessor& a = accessors_[reference(*indices, accessors_.size(), "accessors", place + ".indices")];
                if (a.type != "SCALAR" || (a.component != 5121 && a.component != 5123 && a.component != 5125)) {
                    fail(place + ".indices", "is no accessor of unsigned scalars");
                }
            }
            const json* attributes = find(primitive, "attributes");
            if (!attributes || !attributes->is_object()) {
                fail(place, "has no attributes");
            }
            for (const auto& [key, value] : attributes->items()) {
                const std::string attribute = fmt::format("{}.attributes.{}", place, key);
                const Accessor& a = accessors_[reference(value, accessors_.size(), "accessors", attribute)];
                if (key == "POSITION" && (a.type != "VEC3" || a.component != 5126)) {
                    fail(attribute, "is to be an accessor of three 32-bit floats");
                }
            }
        }
    }

    /// Every node has one parent at most and no loop: what the specification calls a set of strict trees.
    void nodes() const {
        const std::size_t count = size_of_list("nodes");
        std::vector<std::uint64_t> parent(count, count);
        each("nodes", [&](const json& item, const std::string& name) {
            if (const json* mesh_index = find(item, "mesh")) {
                reference(*mesh_index, size_of_list("meshes"), "meshes", name + ".mesh");
            }
            const auto self = static_cast<std::uint64_t>(&item - &root_["nodes"][0]);
            const json* children = find(item, "children");
            for (std::size_t k = 0; children && children->is_array() && k < children->size(); ++k) {
                const std::uint64_t child =
                    reference((*children)[k], count, "nodes", fmt::format("{}.children[{}]", name, k));
                if (parent[child] != count) {
                    fail(fmt::format("nodes[{}]", child), "has two parents");
                }
                parent[child] = self;
            }
        });
        for (std::size_t i = 0; i < count; ++i) {
            std::size_t depth = 0;
            for (std::uint64_t node = i; node != count; node = parent[node]) {
                if (++depth > deepest) {
                    fail(fmt::format("nodes[{}]", i),
                         fmt::format("is its own ancestor, or lies more than {} deep", deepest));
                }
            }
        }
        each("scenes", [&](const json& item, const std::string& name) {
            const json* roots = find(item, "nodes");
            for (std::size_t k = 0; roots && roots->is_array() && k < roots->size(); ++k) {
                reference((*roots)[k], count, "nodes", fmt::format("{}.nodes[{}]", name, k));
            }
        });
    }

    const Source& source_;
    const json& root_;
    std::uint64_t binary_, max_count_;
    std::vector<std::uint64_t> buffers_, views_; ///< lengths
    std::vector<Accessor> accessors_;
};

} // namespace

void check_gltf(const Source& source, const MeshBuilder& builder) {
    const Parts parts = parts_of(source);
    check_depth(source, parts.text);
    const json root = json::parse(parts.text, nullptr, false);
    if (!root.is_object()) {
        throw source.error("it holds no glTF: its text is no JSON object; remedy: export or copy it again");
    }
    GltfCheck(source, root, parts.binary, builder.max_triangles()).run();
}

} // namespace foam::load_assimp
