// glTF: its JSON with places, its containers, accessors and extensions.
#pragma once

#include "part.hpp"
#include "text.hpp"

#include <nlohmann/json.hpp>

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace foam::load_mesh {

/// Decodes a text. White space and missing padding are allowed. Empty if there is another character.
std::optional<std::string> from_base64(std::string_view text);

/// A value of a JSON document and its path from the root, e.g. "meshes[0].primitives[2].indices". Refers to both.
class JsonPlace {
public:
    JsonPlace(const Source& source, const nlohmann::json& root) : source_(&source), value_(&root) {}

    const std::string& path() const { return path_; }
    /// Returns Error(input) "FILE: PATH what; remedy: …".
    Error error(std::string_view what) const;

    /// Returns the member of an object; empty if there is none or this is not an object.
    std::optional<JsonPlace> find(std::string_view key) const;
    JsonPlace at(std::string_view key) const;
    /// Returns the number of items of an array; 0 if this is not one.
    std::size_t size() const { return value_->is_array() ? value_->size() : 0; }
    JsonPlace operator[](std::size_t index) const;
    /// Returns the item of list `key` of `root` at this index.
    JsonPlace target(const JsonPlace& root, std::string_view key) const;

    std::uint64_t natural() const;
    double number() const;
    /// Returns an array of that many numbers.
    std::vector<double> numbers(std::size_t count) const;
    /// Returns the text; empty if this is not a text.
    std::string text() const { return value_->is_string() ? value_->get<std::string>() : std::string(); }

    std::uint64_t natural(std::string_view key, std::uint64_t otherwise) const;
    /// Returns the flag; false if there is no such member.
    bool flag(std::string_view key) const;
    /// Returns whether it is the same value of the same document.
    bool operator==(const JsonPlace& other) const { return value_ == other.value_; }

private:
    const Source* source_;
    const nlohmann::json* value_;
    std::string path_;
};

struct GltfContainer {
    std::string_view text;
    std::string_view binary; ///< of a GLB; empty otherwise
};

/// Splits a file. Throws Error(input) for a GLB that has another version or is truncated.
GltfContainer open_gltf(const Source& source);

/// Reads accessors and opens the required buffers once. Names and rules after the Khronos glTF 2.0 specification,
/// section 3.6, with the integer positions of KHR_mesh_quantization.
class GltfAccessors {
public:
    /// Keeps the document. `binary`: the binary chunk of a GLB. Buffers may have `max_bytes` together, accessors
    /// `max_count` elements each.
    GltfAccessors(const Source& source, const JsonPlace& root, std::string_view binary, std::uintmax_t max_bytes,
                  std::uint64_t max_count);

    /// Returns the accessor with this index as points, which need not be finite.
    std::vector<Vec3> points(const JsonPlace& index);
    /// Returns its elements of `width` numbers (VEC3, VEC4) in a row.
    std::vector<double> vectors(const JsonPlace& index, std::uint64_t width);
    /// Returns its elements as unsigned integers.
    std::vector<std::uint32_t> indices(const JsonPlace& index);

private:
    enum class Component : std::uint64_t { int8 = 5120, uint8, int16, uint16, uint32 = 5125, float32 };
    struct Shape {
        std::uint64_t count, width; ///< width: components of an element
        Component component;
        bool normalized;
    };

    std::vector<double> values(const JsonPlace& accessor, const Shape& shape);
    std::vector<double> dense(const JsonPlace& item, const Shape& shape);
    void put_sparse(const JsonPlace& sparse, const Shape& shape, std::vector<double>& values);
    std::string_view buffer(const JsonPlace& item);
    std::string open(const JsonPlace& uri);
    std::uint64_t count_of(const JsonPlace& item) const;

    static Component component_of(const JsonPlace& item);
    static std::uint64_t size_of(Component component);
    static double value_at(const char* bytes, Component component, bool normalized);

    const Source& source_;
    JsonPlace root_;
    std::string_view binary_;
    std::uintmax_t bytes_left_;
    std::uint64_t max_count_;
    std::map<std::string, std::string> buffers_; ///< by path; without the chunk of a GLB
};

/// Throws for a required extension that is not supported; warns of a used one that may affect the shape.
void check_extensions(const Source& source, const JsonPlace& root, Context& context);

/// Returns the poses of the node's mesh: `pose`, or with EXT_mesh_gpu_instancing the poses of the extension, each
/// followed by `pose`.
std::vector<Affine> instances(const JsonPlace& node, const Affine& pose, GltfAccessors& accessors);

} // namespace foam::load_mesh
