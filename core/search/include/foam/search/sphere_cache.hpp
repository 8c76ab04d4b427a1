// A cache of covering spheres for objects that recur.
#pragma once

#include <foam/search/spherize.hpp>

#include <cstddef>
#include <memory>

namespace foam {
inline namespace [[gnu::visibility("default")]] search {

/// A cache of covering spheres. The key is the mesh (a digest of 128 bits of its bytes), the count, the effort and the
/// seed. It lives in memory. Any number of threads may use it at once; two that request the same unknown cover at the
/// same time both compute it.
class SphereCache {
public:
    /// Keeps at most `capacity` covers, the most recently used; 0 keeps none.
    explicit SphereCache(std::size_t capacity = 1000);
    ~SphereCache();
    SphereCache(const SphereCache&) = delete;
    SphereCache& operator=(const SphereCache&) = delete;

    /// Returns the result of foam::spherize(), and throws as it does. A cover whose search `options.stop` ended is not
    /// kept.
    std::shared_ptr<const SphereCover> spherize(const Mesh& mesh, std::size_t count, const CoverOptions& options = {});

    struct Use {
        std::size_t covers = 0; ///< in the cache now
        std::size_t hits = 0, misses = 0;
    };
    Use use() const;

private:
    struct Data;
    std::unique_ptr<Data> data_;
};

} // namespace search
} // namespace foam
