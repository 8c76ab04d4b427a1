// The stages of the plugin: one class, many settings.
#pragma once

#include "settings.hpp"

#include <foam/sdk/stage.hpp>

namespace foam::medial {

class MedialSpherizer final : public Spherizer {
public:
    explicit MedialSpherizer(const Settings& settings);
    ~MedialSpherizer() override;

    SphereTree spherize(const Shape& shape, const Budget& budget, Context& context) const override;
    /// Budgets of similar size share cover points, columns, medial axis and reductions.
    std::vector<SphereTree> spherize_each(const Shape& shape, std::span<const Budget> budgets,
                                          Context& context) const override;

private:
    std::vector<SphereTree> made(const Shape& shape, std::span<const Budget> budgets, Context& context) const;

    Settings settings_;
};

} // namespace foam::medial
