// Results as arrays of NumPy.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace foam::inline batch {

/// The content of an .npz file: id (N), start (N + 1), spheres (M, 4), certified (N), excess (N). The spheres of mesh i
/// are spheres[start[i]:start[i + 1]], in metres; a mesh that failed has none.
class Arrays {
public:
    /// Adds a result.
    void add(const nlohmann::ordered_json& result);
    /// Writes the file: arrays as numpy.load() reads them. Throws Error(output).
    void write(const std::filesystem::path& file) const;

private:
    std::vector<std::string> ids_;
    std::vector<std::int64_t> starts_{0};
    std::vector<double> spheres_, excess_;
    std::vector<char> certified_;
};

} // namespace foam::batch
