// References that are wrong as they are written, read as other programs read them.
#include <foam/base/text.hpp>
#include <foam/sdk/resource.hpp>

#include <algorithm>
#include <system_error>

namespace foam::inline sdk {
namespace {

namespace fs = std::filesystem;

/// A way to read a reference, and what is wrong with it then.
struct Guess {
    std::string reference, fault;
};

std::string trimmed(std::string text) {
    constexpr const char* blanks = " \t\r\n";
    text.erase(0, std::min(text.find_first_not_of(blanks), text.size()));
    text.erase(text.find_last_not_of(blanks) + 1);
    return text;
}

/// Returns the path without "../", "./" and "/" at its beginning.
std::string without_start(std::string path) {
    while (path.starts_with("../") || path.starts_with("./") || path.starts_with("/")) {
        path.erase(0, path.find('/') + 1);
    }
    return path;
}

/// Returns the reference in the letters that it should have, and guesses of what it means.
std::vector<Guess> guesses_of(std::string& reference) {
    std::vector<Guess> guesses;
    const std::string written = reference;
    reference = trimmed(reference);
    if (reference != written) {
        guesses.push_back({reference, "it has blanks around it"});
    }
    if (reference.find('\\') != std::string::npos) {
        std::replace(reference.begin(), reference.end(), '\\', '/');
        guesses.push_back({reference, "it has backslashes"});
    }
    const std::size_t scheme = reference.starts_with("package://") ? 10 : reference.starts_with("model://") ? 8 : 0;
    if (scheme > 0 && reference.substr(scheme).starts_with('/')) {
        reference.erase(scheme, reference.find_first_not_of('/', scheme) - scheme);
        guesses.push_back({reference, "it has more than two slashes before the package"});
    }
    const std::string path = reference.substr(scheme);
    if (reference.find("://") != std::string::npos && scheme == 0) {
        return guesses;
    }
    const std::size_t slash = scheme > 0 ? path.find('/') : path.npos;
    const std::string rest = without_start(slash == path.npos ? path : path.substr(slash + 1));
    const std::string fault = slash != path.npos ? "no package '" + path.substr(0, slash) + "' is found"
                              : scheme > 0       ? "it names no package"
                                                 : "it leads from another folder";
    for (const char* above : {"", "../", "../../", "../../../"}) {
        if (scheme > 0) {
            guesses.push_back({above + without_start(path), "it names no package"});
        }
        guesses.push_back({above + rest, fault});
    }
    return guesses;
}

/// Returns the entry of a folder whose name differs in the case of letters alone; empty if there is not exactly one.
fs::path entry_in_any_case(const fs::path& folder, const fs::path& name) {
    std::error_code error;
    fs::path found;
    for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
        if (lower_case(it->path().filename().string()) == lower_case(name.string())) {
            if (!found.empty()) {
                return {};
            }
            found = it->path();
        }
    }
    return found;
}

/// Returns the file of that path in any case of letters; empty if there is none.
fs::path file_in_any_case(const fs::path& path) {
    std::error_code error;
    fs::path result = path.root_path();
    for (const fs::path& name : path.relative_path()) {
        const fs::path next = result / name;
        result = fs::exists(next, error) ? next : entry_in_any_case(result, name);
        if (result.empty()) {
            return {};
        }
    }
    return fs::is_regular_file(result, error) ? result : fs::path();
}

} // namespace

ResolvedResource ResourceResolver::resolve_leniently(const std::string& reference, const fs::path& base) const {
    ResolvedResource result = resolve(reference, base);
    if (result.found() || reference.empty() || reference.find('\0') != std::string::npos) {
        return result;
    }
    std::string spelled = reference;
    for (const Guess& guess : guesses_of(spelled)) {
        ResolvedResource other = resolve(guess.reference, base);
        for (const fs::path& place : other.tried) {
            if (std::find(result.tried.begin(), result.tried.end(), place) == result.tried.end()) {
                result.tried.push_back(place);
            }
        }
        if (other.found()) {
            result.path = std::move(other.path);
            result.fault = guess.fault;
            return result;
        }
    }
    for (const fs::path& place : result.tried) {
        if (fs::path file = file_in_any_case(place); !file.empty()) {
            result.path = std::move(file);
            result.fault = "the case of its letters is another";
            break;
        }
    }
    return result;
}

} // namespace foam::inline sdk
