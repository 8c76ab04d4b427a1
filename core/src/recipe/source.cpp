#include "source.hpp"

#include <algorithm>
#include <fstream>

namespace foam::reading {

namespace fs = std::filesystem;

std::string read_text(const fs::path& file, std::string& text) {
    std::error_code error;
    const fs::file_status status = fs::status(file, error);
    if (!fs::exists(status)) {
        return "there is no such file; remedy: check the path";
    }
    if (fs::is_directory(status)) {
        return "it is a folder; remedy: name the recipe file in it";
    }
    std::ifstream stream(file, std::ios::binary);
    // Devices and pipes have no size.
    constexpr std::size_t most = 1'000'001;
    text.resize(most);
    stream.read(text.data(), static_cast<std::streamsize>(most));
    text.resize(static_cast<std::size_t>(std::max<std::streamsize>(stream.gcount(), 0)));
    return !stream.eof() && text.size() < most ? "it cannot be read; remedy: check its permissions" : "";
}

} // namespace foam::reading
