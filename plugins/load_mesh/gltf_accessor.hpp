// Numbers in the buffers of a glTF file: accessors, views, buffers.
#pragma once

#include "json_place.hpp"

#include <map>

namespace foam::load_mesh {

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

} // namespace foam::load_mesh
