// What @stage@ is to do beyond the contract of all mesh filters. Exit code 0: good.
#include <foam/runtime/contract.hpp>
#include <foam/sdk/registry.hpp>

#include <cstdio>

int main() {
    foam::Registry registry;
    registry.load(FOAM_TEST_PLUGIN);
    foam::QuietContext context;
    const foam::Mesh box = foam::sample::box({0.1, 0.1, 0.4});

    const foam::Mesh same = registry.make<foam::MeshFilter>("@stage@", {{"share", 0.0}})->apply(box, context);
    if (same != box) {
        std::printf("a share of 0 changes a box\n");
        return 1;
    }
    const foam::Mesh rounder = registry.make<foam::MeshFilter>("@stage@")->apply(box, context);
    if (!(foam::signed_volume(rounder) < foam::signed_volume(box))) {
        std::printf("a box does not become rounder\n");
        return 1;
    }
    return 0;
}
