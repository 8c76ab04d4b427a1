// The spheres of a written file.
#pragma once

#include <foam/sdk/stage.hpp>

#include <map>
#include <string>
#include <vector>

namespace foam::test {

/// Returns the spheres that a writer reads back, by link, without links that have none.
inline std::map<std::string, std::vector<Sphere>> read_spheres(const Writer& writer, const std::string& bytes) {
    std::map<std::string, std::vector<Sphere>> result;
    for (const auto& [link, elements] : writer.read(bytes)) {
        if (!elements.spheres().empty()) {
            result[link] = elements.spheres();
        }
    }
    return result;
}

} // namespace foam::test
