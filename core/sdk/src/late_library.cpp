#include <foam/base/error.hpp>
#include <foam/sdk/late_library.hpp>

#include <dlfcn.h>

namespace foam::inline sdk {

void* open_late_library(const LateLibrary& library, const void* own_function) {
    const std::string stage = std::string(library.stage) + ": ";
    Dl_info self{};
    if (dladdr(own_function, &self) == 0 || self.dli_fname == nullptr) {
        throw Error(ErrorCode::internal, stage + "the place of the plugin's own file is unknown");
    }
    const auto file = std::filesystem::weakly_canonical(self.dli_fname).parent_path() / library.file;
    void* handle = dlopen(file.c_str(), RTLD_LAZY | RTLD_LOCAL | RTLD_NODELETE);
    if (handle == nullptr) {
        throw Error(ErrorCode::plugin, stage + "cannot open " + file.string() + ": " + dlerror() + "; remedy: " +
                                           library.cure);
    }
    void* entry = dlsym(handle, library.entry);
    if (entry == nullptr) {
        throw Error(ErrorCode::plugin, stage + file.string() + " has no entry point " + library.entry +
                                           "; remedy: build foam anew, the file is of another version");
    }
    return entry;
}

} // namespace foam::sdk
