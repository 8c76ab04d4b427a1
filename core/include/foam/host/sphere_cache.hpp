// Covers of objects that come again: found once, then looked up.
#pragma once

#include <foam/host/spherize.hpp>

#include <cstddef>
#include <memory>

namespace foam {

/// Remembers covers by what was asked: the bytes of the mesh (a digest of 128 bits stands for them), the count, the
/// effort and the seed. In memory, for as long as it lives. For any number of threads at once; two that ask for the
/// same unknown cover at the same time both look for it.
class SphereCache {
public:
    /// Keeps at most `capacity` covers, those used last; 0 keeps none.
    explicit SphereCache(std::size_t capacity = 1000);
    ~SphereCache();
    SphereCache(const SphereCache&) = delete;
    SphereCache& operator=(const SphereCache&) = delete;

    /// What foam::spherize() gives, and throws. A cover whose search `options.stop` has ended is not kept.
    std::shared_ptr<const Cover> spherize(const Mesh& mesh, std::size_t count, const SpherizeOptions& options = {});

    struct Use {
        std::size_t covers = 0; ///< kept now
        std::size_t hits = 0, misses = 0;
    };
    Use use() const;

private:
    struct Data;
    std::unique_ptr<Data> data_;
};

} // namespace foam
