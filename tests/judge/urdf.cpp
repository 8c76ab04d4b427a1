#include "urdf.hpp"

#include "mesh_files.hpp"

#include <stdexcept>

namespace judge {

std::vector<LinkCollisions> collisions_of(const std::filesystem::path& file, const std::set<std::string>& without) {
    std::vector<LinkCollisions> links;
    for (const Element& element : parse_xml(bytes_of(file)).children) {
        if (element.name != "link" || without.contains(element.attribute("name"))) {
            continue;
        }
        LinkCollisions link{element.attribute("name"), {}};
        for (const Element& child : element.children) {
            if (child.name == "collision") {
                link.collisions.push_back(child);
            }
        }
        if (!link.collisions.empty()) {
            links.push_back(std::move(link));
        }
    }
    return links;
}

std::filesystem::path resolved(const std::string& reference, const std::filesystem::path& folder) {
    const std::string scheme = "package://";
    std::string rest = reference.starts_with(scheme) ? reference.substr(scheme.size()) : reference;
    if (rest.starts_with("file://")) {
        rest = rest.substr(7);
    }
    for (std::filesystem::path around = folder.empty() ? std::filesystem::current_path()
                                                       : std::filesystem::absolute(folder);
         ; around = around.parent_path()) {
        if (std::filesystem::is_regular_file(around / rest)) {
            return around / rest;
        }
        if (around == around.parent_path()) {
            throw std::runtime_error(reference + ": not found from " + folder.string());
        }
    }
}

} // namespace judge
