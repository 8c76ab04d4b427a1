#include "allocate/covering.hpp"

#include <foam/geometry/measure.hpp>
#include <foam/runtime/internal/elements.hpp>

namespace foam::inline runtime {

Elements CoveringElements::of(const Group& group, std::size_t count) {
    return moved(of_shape(group.shape, count), group.frame);
}

const Elements& CoveringElements::of_shape(std::size_t shape, std::size_t count) {
    const auto [known, fresh] = known_.try_emplace({shape, count});
    if (fresh) {
        known->second = shapes_[shape].known.trees.at(count).elements();
        if (workspace_.recipe.guarantee == Guarantee::outer) {
            known->second = grown_to_cover(shapes_[shape].shape->original(), std::move(known->second));
        }
    }
    return known->second;
}

} // namespace foam::runtime
