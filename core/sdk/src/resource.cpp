#include <foam/base/file.hpp>
#include <foam/base/text.hpp>
#include <foam/sdk/resource.hpp>

#include <algorithm>
#include <cstdlib>
#include <string_view>
#include <system_error>

namespace foam::inline sdk {
namespace {

namespace fs = std::filesystem;

bool is_file(const fs::path& path) {
    std::error_code error;
    return fs::is_regular_file(path, error);
}

bool is_folder(const fs::path& path) {
    std::error_code error;
    return fs::is_directory(path, error);
}

fs::path absolute_path(const fs::path& path) {
    std::error_code error;
    const fs::path result = path.empty() ? fs::current_path(error) : fs::absolute(path, error);
    return error ? path : result;
}

/// Returns the path without "." and doubled separators. A path with ".." stays unchanged: across a symbolic link only
/// the file system knows what ".." means.
fs::path tidy(const fs::path& path) {
    return std::find(path.begin(), path.end(), "..") == path.end() ? path.lexically_normal() : path;
}

/// Returns the text of <name> in a package.xml (REP 149); empty if there is none.
std::string package_name(const fs::path& directory) {
    constexpr std::uintmax_t most = 1'000'000; // only a small regular file is read
    std::string text = read_regular_file(directory / "package.xml", most, "").bytes;
    for (std::size_t begin; (begin = text.find("<!--")) != std::string::npos;) {
        const std::size_t end = text.find("-->", begin);
        text.erase(begin, end == std::string::npos ? end : end + 3 - begin);
    }
    const std::size_t tag = text.find("<name>");
    const std::size_t end = text.find("</name>", tag == std::string::npos ? text.size() : tag);
    if (tag == std::string::npos || end == std::string::npos) {
        return {};
    }
    const std::string name = text.substr(tag + 6, end - tag - 6);
    const std::size_t first = name.find_first_not_of(" \t\r\n");
    return first == std::string::npos ? "" : name.substr(first, name.find_last_not_of(" \t\r\n") - first + 1);
}

/// Returns `directory` and the folders above it, first as written, then without symbolic links.
std::vector<fs::path> ancestors(const fs::path& directory) {
    std::vector<fs::path> result;
    std::error_code error;
    const fs::path written = absolute_path(directory);
    for (fs::path start : {tidy(written), fs::weakly_canonical(written, error)}) {
        if (!start.has_filename()) {
            start = start.parent_path(); // "dir/" is dir
        }
        for (; !start.empty(); start = start.parent_path()) {
            if (std::find(result.begin(), result.end(), start) == result.end()) {
                result.push_back(start);
            }
            if (start == start.parent_path()) {
                break;
            }
        }
    }
    return result;
}

std::vector<fs::path> visible_folders(const fs::path& directory) {
    std::vector<fs::path> folders;
    std::error_code error;
    for (fs::directory_iterator it(directory, error), end; !error && it != end; it.increment(error)) {
        if (!it->path().filename().string().starts_with('.') && is_folder(it->path())) {
            folders.push_back(it->path());
        }
    }
    std::sort(folders.begin(), folders.end());
    return folders;
}

/// Tries paths in order, and keeps a list of them.
class Search {
public:
    bool found() const { return result_.found(); }
    ResolvedResource take() { return std::move(result_); }

    void try_path(const fs::path& path) {
        const fs::path candidate = tidy(absolute_path(path));
        if (found() || std::find(result_.tried.begin(), result_.tried.end(), candidate) != result_.tried.end()) {
            return;
        }
        result_.tried.push_back(candidate);
        if (is_file(candidate)) {
            result_.path = candidate;
        }
    }

    /// Tries the package as a folder in `directory`, and `directory` itself as the package.
    void try_package(const fs::path& directory, const std::string& package, const std::string& rest) {
        try_path(directory / package / rest);
        if (!found() &&
            (tidy(directory / "").parent_path().filename() == package || package_name(directory) == package)) {
            try_path(directory / rest);
        }
    }

    /// Tries the folders one and two levels below `directory`; the list of places shows them as "*".
    void try_workspace(const fs::path& directory, const std::string& package, const std::string& rest) {
        try_below(directory, package, rest, 2);
        if (!found()) {
            result_.tried.push_back(tidy(absolute_path(directory)) / "*" / package / rest);
            result_.tried.push_back(tidy(absolute_path(directory)) / "*" / "*" / package / rest);
        }
    }

    /// Tries folders beside those of `base` and above it whose package.xml names the package.
    void try_beside(const fs::path& base, const std::string& package, const std::string& rest) {
        constexpr int levels = 4;
        fs::path folder = tidy(absolute_path(base));
        for (int i = 0; i < levels && folder.has_relative_path() && !found(); ++i, folder = folder.parent_path()) {
            for (const fs::path& beside : visible_folders(folder)) {
                if (!found() && package_name(beside) == package) {
                    try_path(beside / rest);
                }
            }
            if (!found() && is_folder(folder)) {
                result_.tried.push_back(folder / "*" / rest);
            }
        }
    }

private:
    void try_below(const fs::path& directory, const std::string& package, const std::string& rest, int levels) {
        for (const fs::path& folder : found() || levels == 0 ? std::vector<fs::path>{} : visible_folders(directory)) {
            if (is_folder(folder / package) || package_name(folder) == package) {
                try_package(folder, package, rest);
            }
            try_below(folder, package, rest, levels - 1);
        }
    }

    ResolvedResource result_;
};

void add_from_environment(std::vector<fs::path>& path, const char* variable, const char* below) {
    const char* value = std::getenv(variable);
    std::string_view rest = value ? value : "";
    while (!rest.empty()) {
        const std::size_t end = std::min(rest.find(':'), rest.size());
        if (end > 0) {
            path.push_back(*below ? fs::path(rest.substr(0, end)) / below : fs::path(rest.substr(0, end)));
        }
        rest.remove_prefix(std::min(end + 1, rest.size()));
    }
}

/// Returns the parts of NAME=FOLDER; no name for a folder.
std::pair<std::string, fs::path> name_and_folder(const fs::path& entry) {
    const std::string text = entry.string();
    const std::size_t equals = text.find('=');
    const bool named = equals != text.npos && equals > 0 && text.find('/') > equals && !is_folder(entry);
    return named ? std::pair(text.substr(0, equals), fs::path(text.substr(equals + 1)))
                 : std::pair(std::string(), entry);
}

void search_package(Search& search, std::string_view location, const std::vector<fs::path>& package_path,
                    const fs::path& base) {
    const std::size_t slash = location.find('/');
    if (slash == 0 || slash == std::string_view::npos) {
        return; // no package name, or no file
    }
    std::vector<std::string> readings{percent_decoded(location)};
    if (readings.front() != location) {
        readings.emplace_back(location);
    }
    for (const std::string& text : readings) {
        const std::string package = text.substr(0, text.find('/'));
        // Not fs::path's "/", for which "package://PKG//rest" would give the absolute path "/rest".
        const std::string rest = text.substr(std::min(text.find_first_not_of('/', package.size()), text.size()));
        std::vector<fs::path> folders;
        for (const fs::path& entry : package_path) {
            const auto [name, folder] = name_and_folder(entry);
            if (name.empty()) {
                folders.push_back(folder);
            } else if (name == package) {
                search.try_path(folder / rest);
            }
        }
        for (const fs::path& directory : folders) {
            search.try_package(directory, package, rest);
        }
        for (const fs::path& directory : ancestors(base)) {
            search.try_package(directory, package, rest);
        }
        for (const fs::path& directory : folders) {
            search.try_workspace(directory, package, rest);
        }
        search.try_beside(base, package, rest);
    }
}

} // namespace

ResourceResolver::ResourceResolver(std::vector<fs::path> package_path) : package_path_(std::move(package_path)) {}
ResourceResolver::~ResourceResolver() = default;
ResourceResolver::ResourceResolver(const ResourceResolver&) = default;
ResourceResolver& ResourceResolver::operator=(const ResourceResolver&) = default;

ResourceResolver ResourceResolver::from_environment() {
    std::vector<fs::path> path;
    add_from_environment(path, "FOAM_PACKAGE_PATH", "");
    add_from_environment(path, "ROS_PACKAGE_PATH", "");
    add_from_environment(path, "AMENT_PREFIX_PATH", "share");
    add_from_environment(path, "GZ_SIM_RESOURCE_PATH", "");
    return ResourceResolver(std::move(path));
}

ResolvedResource ResourceResolver::resolve(const std::string& reference, const fs::path& base) const {
    Search search;
    const std::size_t colon = reference.find("://");
    if (reference.empty() || reference.find('\0') != std::string::npos) {
        return search.take();
    }
    if (colon == std::string::npos) {
        search.try_path(base / reference);
        search.try_path(base / percent_decoded(reference));
        return search.take();
    }
    const std::string scheme = reference.substr(0, colon);
    std::string_view location = std::string_view(reference).substr(colon + 3);
    if (scheme == "package" || scheme == "model") {
        search_package(search, location, package_path_, base);
    } else if (scheme == "file") {
        if (location.starts_with("localhost/")) {
            location.remove_prefix(std::string_view("localhost").size());
        }
        // Strictly, file://x/y is a file of host x. Many files use it for a relative path.
        search.try_path(base / percent_decoded(location));
        search.try_path(base / std::string(location));
    }
    return search.take();
}

std::vector<std::pair<std::string, fs::path>> ResourceResolver::named_packages() const {
    std::vector<std::pair<std::string, fs::path>> packages;
    for (const fs::path& entry : package_path_) {
        if (auto package = name_and_folder(entry); !package.first.empty()) {
            packages.push_back(std::move(package));
        }
    }
    return packages;
}

std::string package_of(const std::string& reference) {
    const bool is_package = reference.starts_with("package://") || reference.starts_with("model://");
    const std::size_t begin = is_package ? reference.find("://") + 3 : reference.size();
    return reference.substr(begin, reference.find('/', begin) - begin);
}

fs::path package_entry(const std::string& text, const fs::path& base) {
    const auto [name, folder] = name_and_folder(text);
    return name.empty() ? base / folder : fs::path(name + "=" + (base / folder).string());
}

} // namespace foam::inline sdk
