// What @stage@ is to do beyond the contract of all mesh loaders. Exit code 0: good.
#include <foam/base/error.hpp>
#include <foam/sdk/registry.hpp>

#include <cstdio>
#include <cstring>
#include <fstream>

int main() {
    foam::Registry registry;
    registry.load(FOAM_TEST_PLUGIN);
    const auto loader = registry.make<foam::MeshLoader>("@stage@");
    foam::QuietContext context;

    std::ofstream("bad.@method@") << "0 0 0 1 0 0 0 1 0\n0 0 0 1 zero 0 0 1 0\n";
    try {
        loader->load("bad.@method@", context);
        std::printf("a word is taken for a number\n");
        return 1;
    } catch (const foam::Error& error) {
        const char* wanted = "bad.@method@:2: 'zero' is not a finite number";
        if (std::strcmp(error.what(), wanted) != 0) {
            std::printf("message: %s\nwanted: %s\n", error.what(), wanted);
            return 1;
        }
    }
    return 0;
}
