#include <foam/base/internal/digest.hpp>

#include <fmt/format.h>
#include <xxhash.h>

namespace foam::inline base {

struct Hasher::State {
    XXH3_state_t* xxh = XXH3_createState();
    State() { XXH3_128bits_reset(xxh); }
    ~State() { XXH3_freeState(xxh); }
    State(const State&) = delete;
    State& operator=(const State&) = delete;
};

namespace {
Digest hex(const XXH128_hash_t& hash) {
    return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}
} // namespace

Hasher::Hasher() : state_(std::make_unique<State>()) {}
Hasher::~Hasher() = default;

void Hasher::bytes(const void* data, std::size_t size) {
    XXH3_128bits_update(state_->xxh, data, size);
}

Hasher& Hasher::add(std::string_view text) {
    add(static_cast<std::uint64_t>(text.size()));
    bytes(text.data(), text.size());
    return *this;
}

Hasher& Hasher::add(std::uint64_t value) {
    bytes(&value, sizeof value);
    return *this;
}

Hasher& Hasher::add(double value) {
    value += 0.0; // -0 and 0 are one value
    bytes(&value, sizeof value);
    return *this;
}

Digest Hasher::finish() const {
    return hex(XXH3_128bits_digest(state_->xxh));
}

Digest digest_of(std::string_view bytes) {
    return hex(XXH3_128bits(bytes.data(), bytes.size()));
}

} // namespace foam::base
