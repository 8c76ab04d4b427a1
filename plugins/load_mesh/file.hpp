// Reading a whole file, not more than wanted.
#pragma once

#include <foam/error.hpp>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

namespace foam::load_mesh {

/// The bytes of a regular file; throws error(what), e.g. "there is no such file", if they cannot be read or are more
/// than `max_bytes`.
std::string bytes_of(const std::filesystem::path& file, std::uintmax_t max_bytes,
                     const std::function<Error(const std::string& what)>& error);

} // namespace foam::load_mesh
