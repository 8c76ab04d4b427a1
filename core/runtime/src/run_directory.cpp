#include <foam/runtime/internal/run_directory.hpp>

#include <foam/base/error.hpp>
#include <foam/base/internal/files.hpp>

#include <fmt/format.h>

#include <fcntl.h>
#include <stdio.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace foam::inline runtime {
namespace fs = std::filesystem;
namespace {

bool replaceable(const fs::path& target, const char* mark) {
    std::error_code error;
    const auto status = fs::symlink_status(target, error);
    if (!fs::exists(status)) {
        return true;
    }
    return fs::is_directory(status) && (fs::is_empty(target, error) || fs::exists(target / mark, error));
}

} // namespace

RunDirectory::RunDirectory(fs::path target, const char* mark) : target_(fs::absolute(target).lexically_normal()) {
    if (target_.filename().empty()) {
        target_ = target_.parent_path();
    }
    if (!replaceable(target_, mark)) {
        throw Error(ErrorCode::output,
                    fmt::format("{}: exists, but is not the folder of a run (no {} in it), so foam does not replace "
                                "it; remedy: choose another folder with --run-dir, or remove it",
                                target_.string(), mark));
    }
    temporary_ = target_.parent_path() / fmt::format(".{}.partial-{}", target_.filename().string(), getpid());
    unfinished_.emplace(temporary_);
    std::error_code error;
    fs::remove_all(temporary_, error);
    fs::create_directories(temporary_, error);
    if (error) {
        throw Error(
            ErrorCode::output,
            fmt::format("{}: the run directory cannot be made: {}; remedy: choose another folder with --run-dir",
                        target_.string(), error.message()));
    }
}

RunDirectory::~RunDirectory() {
    if (!committed_) {
        std::error_code ignored;
        fs::remove_all(temporary_, ignored);
    }
}

void RunDirectory::write(const fs::path& file, std::string_view bytes) const {
    write_file(temporary_ / file, bytes);
}

void RunDirectory::commit() {
    // An existing run is exchanged with the new one in one step, so that the name always has a complete run.
    const bool exchange = fs::exists(target_);
    if (renameat2(AT_FDCWD, temporary_.c_str(), AT_FDCWD, target_.c_str(), exchange ? RENAME_EXCHANGE : 0) != 0) {
        std::error_code error;
        if (exchange) { // the file system does not support the exchange
            fs::remove_all(target_, error);
        }
        fs::rename(temporary_, target_, error);
        if (error) {
            throw Error(ErrorCode::output,
                        fmt::format("{}: cannot be put in place: {}", target_.string(), error.message()));
        }
        committed_ = true;
        unfinished_.reset();
        return;
    }
    committed_ = true;
    if (exchange) {
        std::error_code ignored;
        fs::remove_all(temporary_, ignored);
    }
    unfinished_.reset();
}

} // namespace foam::runtime
