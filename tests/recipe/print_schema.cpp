// Prints the JSON Schema of recipes with the stages of the plugins given.
#include <foam/recipe/recipe.hpp>

#include <cstdio>

int main(int count, char** arguments) {
    foam::Registry registry;
    for (int i = 1; i < count; ++i) {
        if (const auto& record = registry.load(arguments[i]); !record.loaded()) {
            std::fprintf(stderr, "%s: %s\n", arguments[i], record.rejection.c_str());
            return 3;
        }
    }
    std::fputs(foam::recipe_schema(registry).c_str(), stdout);
}
