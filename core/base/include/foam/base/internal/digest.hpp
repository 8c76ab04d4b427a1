// Content digests: the content of a value determines its name.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace foam {
inline namespace [[gnu::visibility("default")]] base {

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
    /// Adds a value of another library by its function add_to(Hasher&, const T&).
    template <class T>
        requires requires(Hasher& hasher, const T& value) { add_to(hasher, value); }
    Hasher& add(const T& value) {
        add_to(*this, value);
        return *this;
    }
    /// Adds bytes without their number.
    void bytes(const void* data, std::size_t size);
    Digest finish() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

Digest digest_of(std::string_view bytes);
/// Returns the digest of one value.
template <class T> Digest digest_of_content(const T& content) {
    return Hasher().add(content).finish();
}

} // namespace base
} // namespace foam
