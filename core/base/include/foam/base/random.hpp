// Random numbers that are the same on every machine and standard library.
#pragma once

#include <cstdint>
#include <string_view>

namespace foam {
inline namespace [[gnu::visibility("default")]] base {

/// SplitMix64 (Steele, Lea, Flood 2014): 64 bits of state, passes BigCrush, one multiplication chain per draw. The
/// distributions of std differ between libraries, so this class maps to doubles and ranges itself.
class Random {
public:
    explicit constexpr Random(std::uint64_t seed) : state_(seed) {}

    constexpr std::uint64_t bits() {
        std::uint64_t z = (state_ += 0x9E3779B97F4A7C15u);
        z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
        z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
        return z ^ (z >> 31);
    }
    /// Returns a number uniform in [0, 1), with 53 random bits.
    constexpr double uniform() { return static_cast<double>(bits() >> 11) * 0x1.0p-53; }
    constexpr double uniform(double low, double high) { return low + (high - low) * uniform(); }
    /// Returns a number uniform in {0, …, count-1}; count > 0. The bias is below 2^-64 · count.
    constexpr std::uint64_t below(std::uint64_t count) {
        return static_cast<std::uint64_t>((static_cast<Wide>(bits()) * count) >> 64);
    }

private:
    __extension__ using Wide = unsigned __int128;
    std::uint64_t state_;
};

/// Returns a seed for an independent stream. It mixes `seed` with a name (FNV-1a), e.g. derive_seed(context.seed(),
/// "cover").
constexpr std::uint64_t derive_seed(std::uint64_t seed, std::string_view name) {
    std::uint64_t hash = 0xCBF29CE484222325u;
    for (const char c : name) {
        hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001B3u;
    }
    return Random(seed ^ hash).bits();
}

} // namespace base
} // namespace foam
