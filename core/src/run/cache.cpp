#include "cache.hpp"

#include "files.hpp"

#include <foam/error.hpp>

#include <cstdlib>
#include <cstring>

namespace foam {
namespace {

constexpr std::string_view magic = "foam cache 1\n";

template <class T> void put_values(std::string& out, const std::vector<T>& values) {
    const std::uint64_t count = values.size();
    out.append(reinterpret_cast<const char*>(&count), sizeof count);
    out.append(reinterpret_cast<const char*>(values.data()), count * sizeof(T));
}

/// Takes values off the front of a text; false when it is too short.
template <class T> bool take_values(std::string_view& in, std::vector<T>& values) {
    std::uint64_t count = 0;
    if (in.size() < sizeof count) {
        return false;
    }
    std::memcpy(&count, in.data(), sizeof count);
    in.remove_prefix(sizeof count);
    if (count > in.size() / sizeof(T)) {
        return false;
    }
    values.resize(count);
    if (count > 0) {
        std::memcpy(static_cast<void*>(values.data()), in.data(), count * sizeof(T));
    }
    in.remove_prefix(count * sizeof(T));
    return true;
}

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
    std::string_view in = *payload;
    Mesh mesh;
    if (!take_values(in, mesh.vertices) || !take_values(in, mesh.triangles) || !in.empty()) {
        return std::nullopt;
    }
    return mesh;
}

void Cache::put(const Digest& key, const Mesh& mesh) const {
    std::string payload;
    put_values(payload, mesh.vertices);
    put_values(payload, mesh.triangles);
    store(key, std::move(payload));
}

std::optional<SphereTree> Cache::tree(const Digest& key) const {
    const auto payload = load(key);
    if (!payload) {
        return std::nullopt;
    }
    std::string_view in = *payload;
    SphereTree tree;
    while (!in.empty()) {
        SphereTree::Level level;
        if (!take_values(in, level.spheres) || !take_values(in, level.parents)) {
            return std::nullopt;
        }
        tree.levels.push_back(std::move(level));
    }
    return tree.levels.empty() ? std::nullopt : std::optional(tree);
}

void Cache::put(const Digest& key, const SphereTree& tree) const {
    std::string payload;
    for (const SphereTree::Level& level : tree.levels) {
        put_values(payload, level.spheres);
        put_values(payload, level.parents);
    }
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
