#include "cache.hpp"

#include "bytes.hpp"
#include "files.hpp"

#include <foam/error.hpp>

#include <cstdlib>

namespace foam {
namespace {

constexpr std::string_view magic = "foam cache 2\n";

} // namespace

Cache::Cache(std::filesystem::path folder) : folder_(std::move(folder)) {}

std::filesystem::path Cache::file(const Digest& key) const {
    return folder_ / key.substr(0, 2) / key.substr(2);
}

std::optional<std::string> Cache::load(const Digest& key) const {
    std::error_code error;
    if (folder_.empty() || !std::filesystem::exists(file(key), error)) {
        return std::nullopt;
    }
    try {
        const std::string bytes = read_file(file(key));
        const std::size_t head = magic.size() + 32;
        if (bytes.size() < head || !bytes.starts_with(magic)) {
            return std::nullopt;
        }
        std::string payload = bytes.substr(head);
        if (digest_of(payload) != bytes.substr(magic.size(), 32)) {
            return std::nullopt;
        }
        return payload;
    } catch (const Error&) {
        return std::nullopt;
    }
}

void Cache::store(const Digest& key, std::string payload) const {
    if (folder_.empty()) {
        return;
    }
    try {
        write_file(file(key), std::string(magic) + digest_of(payload) + payload);
    } catch (const Error&) {
        // A cache that cannot be written costs time, not results.
    }
}

std::optional<Mesh> Cache::mesh(const Digest& key) const {
    const auto payload = load(key);
    if (!payload) {
        return std::nullopt;
    }
    ByteReader in(*payload);
    Mesh mesh = take_mesh(in);
    return in.good() && in.at_end() ? std::optional(std::move(mesh)) : std::nullopt;
}

void Cache::put(const Digest& key, const Mesh& mesh) const {
    std::string payload;
    put_mesh(payload, mesh);
    store(key, std::move(payload));
}

std::optional<SphereTree> Cache::tree(const Digest& key) const {
    const auto payload = load(key);
    if (!payload) {
        return std::nullopt;
    }
    ByteReader in(*payload);
    SphereTree tree = take_tree(in);
    return in.good() && in.at_end() && !tree.levels.empty() ? std::optional(std::move(tree)) : std::nullopt;
}

void Cache::put(const Digest& key, const SphereTree& tree) const {
    std::string payload;
    put_tree(payload, tree);
    store(key, std::move(payload));
}

std::filesystem::path Cache::default_folder() {
    const char* cache_home = std::getenv("XDG_CACHE_HOME");
    if (cache_home && *cache_home == '/') {
        return std::filesystem::path(cache_home) / "foam";
    }
    const char* home = std::getenv("HOME");
    return home && *home == '/' ? std::filesystem::path(home) / ".cache" / "foam" : std::filesystem::path();
}

} // namespace foam
