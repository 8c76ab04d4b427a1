// What @stage@ is to do beyond the contract of all spherizers. Exit code 0: good.
#include <foam/runtime/contract.hpp>
#include <foam/sdk/registry.hpp>

#include <cstdio>

int main() {
    foam::Registry registry;
    registry.load(FOAM_TEST_PLUGIN);
    const auto spherizer = registry.make<foam::Spherizer>("@stage@");

    const auto bar = foam::Solid::make(foam::sample::box({0.1, 0.1, 0.4}));
    foam::QuietContext context;
    const foam::SphereTree tree = spherizer->spherize({"bar", bar, bar}, {4, {}, foam::Guarantee::outer}, context);
    if (tree.finest().size() != 4) {
        std::printf("a bar gets %zu spheres instead of 4\n", tree.finest().size());
        return 1;
    }
    return 0;
}
