// foam cache: how much it holds; making it smaller.
#include "cli/messages.hpp"
#include "cli/program.hpp"
#include "commands.hpp"

#include <foam/base/error.hpp>
#include <foam/runtime/cache.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <optional>

namespace foam::cli {
namespace {

constexpr double mebibyte = 1024 * 1024;

struct CacheArguments {
    std::optional<std::uint32_t> trim; ///< MiB
    bool clear = false, json = false;
};

std::string contents_text(const CacheContents& contents) {
    return fmt::format("{} entries, {:.1f} MiB", contents.entries, static_cast<double>(contents.bytes) / mebibyte);
}

int cache_command(const CacheArguments& arguments) {
    const std::filesystem::path folder = default_cache_folder();
    if (folder.empty()) {
        throw Error(ErrorCode::usage, "there is no cache: neither XDG_CACHE_HOME nor HOME names a folder");
    }
    const std::uintmax_t limit = cache_limit();
    CacheContents deleted;
    if (arguments.clear || arguments.trim) {
        deleted = trim_cache(folder, arguments.clear ? 0 : std::uintmax_t{*arguments.trim} << 20);
    }
    const std::size_t leftovers = remove_leftovers({folder, "runs", "."});
    const CacheContents left = cache_contents(folder);
    if (arguments.json) {
        const nlohmann::ordered_json json{{"folder", folder.string()},  {"entries", left.entries},
                                          {"bytes", left.bytes},        {"limit_bytes", limit},
                                          {"deleted", deleted.entries}, {"deleted_bytes", deleted.bytes},
                                          {"removed_folders", leftovers}};
        print_json(json);
        return 0;
    }
    std::string text = fmt::format("{}: {}; ", folder.string(), contents_text(left));
    text += limit == 0 ? "without a limit (FOAM_CACHE_LIMIT is 0)"
                       : fmt::format("runs leave at most {} MiB (FOAM_CACHE_LIMIT)", limit >> 20);
    text += deleted.entries > 0 ? fmt::format("; deleted: {}", contents_text(deleted)) : "";
    if (leftovers > 0) {
        tell(fmt::format("removed: {} unfinished folder{} of killed runs", leftovers, leftovers == 1 ? "" : "s"));
    }
    print(text + "\n");
    return 0;
}

} // namespace

void add_cache(Program& program) {
    CLI::App* command = add_command(program, "cache", "Show the size of the cache, or reduce it",
                                    "  foam cache\n"
                                    "  foam cache --trim 500    keep the latest entries, at most 500 MiB\n"
                                    "  foam cache --clear");
    auto arguments = std::make_shared<CacheArguments>();
    CLI::Option* trim =
        command
            ->add_option("--trim", arguments->trim,
                         "Delete the entries that were not used for the longest time, until N MiB are left")
            ->type_name("N")
            ->check(whole_number(0, 1'000'000'000));
    command->add_flag("--clear", arguments->clear, "Delete all entries")->excludes(trim);
    command->add_flag("--json", arguments->json, "Print the result as JSON");
    command->callback([&program, arguments] { program.action = [arguments] { return cache_command(*arguments); }; });
}

} // namespace foam::cli
