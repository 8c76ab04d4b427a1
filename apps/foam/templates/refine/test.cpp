// What @stage@ is to do beyond the contract of all refiners. Exit code 0: good.
#include <foam/runtime/contract.hpp>
#include <foam/sdk/registry.hpp>

#include <cstdio>

int main() {
    foam::Registry registry;
    registry.load(FOAM_TEST_PLUGIN);
    const auto refiner = registry.make<foam::Refiner>("@stage@");
    const auto box = foam::Solid::make({foam::Solid::Part{.mesh = std::make_shared<const foam::Mesh>(foam::sample::box({1, 1, 1}))}});
    const foam::Shape shape("box", box, box);
    foam::QuietContext context;

    const foam::SphereTree tree = foam::flat_tree({{{0, 0, 0}, 0.9}, {{5, 0, 0}, 1}}); // the second holds nothing
    const foam::SphereTree refined = refiner->begin(shape, {})->refine(tree, 2, context);
    if (refined.finest() != std::vector<foam::Sphere>{{{0, 0, 0}, 0.9}}) {
        std::printf("%zu spheres, 1 was expected\n", refined.finest().size());
        return 1;
    }
    return 0;
}
