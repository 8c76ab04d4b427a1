#include "stage.hpp"

namespace {

class Ball final : public foam::Spherizer {
public:
    foam::SphereTree spherize(const foam::Shape&, const foam::Budget&, foam::Context&) const override { return {}; }
};

} // namespace

FOAM_PLUGIN("spherizer_named_filter", "1.0", "Apache-2.0") {
    enrol.add<Ball>(info("repair.ball"));
}
