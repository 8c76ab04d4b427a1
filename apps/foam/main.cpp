#include <foam/host/registry.hpp>

#include <fmt/format.h>

int main() {
    foam::Registry registry;
    for (const auto& directory : foam::plugin_directories()) {
        registry.load_directory(directory);
    }
    for (const auto& plugin : registry.plugins()) {
        fmt::print("{} {} {}\n", plugin.file.string(), plugin.name, plugin.rejection);
    }
}
