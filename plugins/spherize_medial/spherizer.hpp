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
    std::unique_ptr<SphereSearch> search(const Shape& shape) const override;

private:
    Settings settings_;
};

} // namespace foam::medial
