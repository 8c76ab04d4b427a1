// The proof on the numbers of a written file.
#pragma once

#include <foam/runtime/internal/links.hpp>

#include <map>
#include <string>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] runtime {

/// The work of the proof on a written file for one link. Guarantee::inner: `pieces` and `halvings` are 0, because
/// nothing is split.
struct WrittenProof {
    std::string link;
    std::size_t spheres = 0; ///< elements of any kind
    std::size_t triangles = 0, pieces = 0;
    std::uint32_t halvings = 0; ///< of the smallest piece; 0 where elements are not all spheres
    bool float32 = false;       ///< the guarantee is also proved for the numbers rounded to single precision
};

/// Proves on the elements read back from a file, by link, what was proved in memory: the guarantee of each link whose
/// report is certified. Numbers::float32: also for these numbers rounded to single precision. Throws Error(internal)
/// for a link without elements, or with spheres alone where the model has others, and where a proof does not hold.
/// `elements_optional`: Consumer's; a link with elements of other kinds than spheres is not proved then.
std::vector<WrittenProof> prove_written(const std::map<std::string, Elements>& read,
                                        const FinishedModel& finished, Guarantee guarantee, Numbers numbers,
                                        const std::string& file, bool elements_optional = false);

} // namespace runtime
} // namespace foam
