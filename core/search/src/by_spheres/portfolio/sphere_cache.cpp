#include <foam/search/sphere_cache.hpp>

#include <foam/geometry/internal/digest.hpp>

#include <list>
#include <mutex>
#include <unordered_map>
#include <utility>

namespace foam::inline search {
namespace {

Digest key_of(const Mesh& mesh, std::size_t count, const CoverOptions& options) {
    return Hasher()
        .add(mesh)
        .add(static_cast<std::uint64_t>(count))
        .add(static_cast<std::uint64_t>(options.effort))
        .add(static_cast<std::uint64_t>(options.objective))
        .add(options.seed)
        .finish();
}

} // namespace

struct SphereCache::Data {
    explicit Data(std::size_t most) : capacity(most) {}

    struct Entry {
        Digest key;
        std::shared_ptr<const SphereCover> cover;
    };
    const std::size_t capacity;
    std::mutex mutex;
    std::list<Entry> entries; ///< the most recently used first
    std::unordered_map<Digest, std::list<Entry>::iterator> places;
    std::size_t hits = 0, misses = 0;

    std::shared_ptr<const SphereCover> find(const Digest& key) {
        const std::lock_guard lock(mutex);
        const auto place = places.find(key);
        if (place == places.end()) {
            ++misses;
            return nullptr;
        }
        ++hits;
        entries.splice(entries.begin(), entries, place->second);
        return entries.front().cover;
    }

    void keep(const Digest& key, const std::shared_ptr<const SphereCover>& cover) {
        const std::lock_guard lock(mutex);
        if (capacity == 0 || places.contains(key)) {
            return;
        }
        entries.push_front({key, cover});
        places[key] = entries.begin();
        if (entries.size() > capacity) {
            places.erase(entries.back().key);
            entries.pop_back();
        }
    }
};

SphereCache::SphereCache(std::size_t capacity) : data_(std::make_unique<Data>(capacity)) {}

SphereCache::~SphereCache() = default;

std::shared_ptr<const SphereCover> SphereCache::spherize(const Mesh& mesh, std::size_t count,
                                                   const CoverOptions& options) {
    const Digest key = key_of(mesh, count, options);
    if (auto known = data_->find(key)) {
        return known;
    }
    bool ended = false;
    CoverOptions watched = options;
    if (options.stop) {
        watched.stop = [&] {
            const bool stop = options.stop();
            ended = ended || stop;
            return stop;
        };
    }
    auto cover = std::make_shared<const SphereCover>(foam::spherize(mesh, count, watched));
    if (!ended) {
        data_->keep(key, cover);
    }
    return cover;
}

SphereCache::Use SphereCache::use() const {
    const std::lock_guard lock(data_->mutex);
    return {data_->entries.size(), data_->hits, data_->misses};
}

} // namespace foam::search
