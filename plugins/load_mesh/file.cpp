#include "file.hpp"

#include <fmt/format.h>

#include <fstream>

namespace foam::load_mesh {

namespace fs = std::filesystem;

std::string bytes_of(const fs::path& file, std::uintmax_t max_bytes,
                     const std::function<Error(const std::string& what)>& error) {
    std::error_code code;
    const fs::file_status status = fs::status(file, code);
    if (!fs::exists(status)) {
        throw error("there is no such file");
    }
    if (!fs::is_regular_file(status)) {
        throw error("it is not a regular file");
    }
    const std::uintmax_t size = fs::file_size(file, code);
    if (code) {
        throw error(code.message());
    }
    if (size > max_bytes) {
        throw error(fmt::format("it has {} bytes, more than {}; remedy: simplify the mesh, or raise max_bytes of "
                                "load.mesh",
                                size, max_bytes));
    }
    std::string bytes(size, '\0');
    std::ifstream stream(file, std::ios::binary);
    if (!stream.read(bytes.data(), static_cast<std::streamsize>(size))) {
        throw error("it cannot be read; remedy: check its permissions");
    }
    return bytes;
}

} // namespace foam::load_mesh
