// Content digests: the content of a value determines its name.
#pragma once

#include <foam/host/recipe.hpp>
#include <foam/measure.hpp>
#include <foam/mesh.hpp>
#include <foam/robot.hpp>
#include <foam/sphere.hpp>

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace foam {

/// 128 bits of XXH3 as 32 hexadecimal digits.
using Digest = std::string;

/// Hashes the values that a digest depends on. Every value is preceded by its length or kind, so that no two sequences
/// of calls give the same bytes.
class Hasher {
public:
    Hasher();
    ~Hasher();
    Hasher(const Hasher&) = delete;
    Hasher& operator=(const Hasher&) = delete;

    Hasher& add(std::string_view text);
    Hasher& add(std::uint64_t value);
    Hasher& add(double value);
    Hasher& add(const Vec3& v);
    Hasher& add(const Pose& pose);
    Hasher& add(const Mesh& mesh);
    Hasher& add(const Primitive& primitive);
    Hasher& add(const SphereTree& tree);
    Hasher& add(const Measures& measures);
    /// Adds links, their collision elements and joints; not the places of files, nor visual geometry.
    Hasher& add(const Robot& robot);
    /// Adds what determines the effect of a stage: name, revision, all parameters that affect its output, defaults
    /// included.
    Hasher& add(const StageCall& call, const Registry& registry);
    Digest finish() const;

private:
    void bytes(const void* data, std::size_t size);
    struct State;
    std::unique_ptr<State> state_;
};

Digest digest_of(std::string_view bytes);
/// Returns the digest of a mesh, a tree, measures or a robot.
template <class T> Digest digest_of_content(const T& content) {
    return Hasher().add(content).finish();
}

} // namespace foam
