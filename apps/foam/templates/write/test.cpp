// What @stage@ is to do beyond the contract of all writers. Exit code 0: good.
#include <foam/sdk/registry.hpp>

#include <cstdio>

int main() {
    foam::Registry registry;
    registry.load(FOAM_TEST_PLUGIN);
    foam::SphereModel model;
    model.groups.push_back({"left finger", {}, foam::flat_tree({{{0.5, -2, 0}, 0.25}}), {}});
    foam::QuietContext context;

    const std::string text = registry.make<foam::Writer>("@stage@")->write(model, context);
    if (text != "# x y z radius link\n0.5 -2 0 0.25 left finger\n") {
        std::printf("another text was expected:\n%s", text.c_str());
        return 1;
    }
    return 0;
}
