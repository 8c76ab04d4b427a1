// What @stage@ is to do beyond the contract of all model readers. Exit code 0: good.
#include <foam/base/error.hpp>
#include <foam/sdk/registry.hpp>

#include <cstdio>
#include <cstring>

int main() {
    foam::Registry registry;
    registry.load(FOAM_TEST_PLUGIN);
    const auto reader = registry.make<foam::ModelReader>("@stage@");
    foam::QuietContext context;

    const foam::SphereFile model = reader->read("spheres @method@\n0.5 -2 0 0.25 tool\n", "a.@method@", context);
    if (model.links.size() != 1 || model.links[0].elements != foam::Elements{{{0.5, -2, 0}, 0.25}}) {
        std::printf("another model was expected\n");
        return 1;
    }
    try {
        reader->read("spheres @method@\n0 zero 0 1 tool\n", "a.@method@", context);
        std::printf("a word is taken for a number\n");
        return 1;
    } catch (const foam::Error& error) {
        const char* wanted = "a.@method@:2: 'zero' is not a finite number";
        if (std::strcmp(error.what(), wanted) != 0) {
            std::printf("message: %s\nwanted: %s\n", error.what(), wanted);
            return 1;
        }
    }
    return 0;
}
