#include <foam/recipe/internal/source.hpp>

#include <foam/base/file.hpp>

namespace foam::inline recipe::reading {

namespace fs = std::filesystem;

std::string read_text(const fs::path& file, std::string& text) {
    std::error_code error;
    if (fs::is_directory(file, error)) {
        return "it is a folder; remedy: name the recipe file in it";
    }
    constexpr std::uintmax_t most = 1'000'000; // the limit of check_text()
    FileContents contents = read_regular_file(file, most, "check that this is a recipe");
    text = std::move(contents.bytes);
    return contents.why_not();
}

} // namespace foam::recipe::reading
