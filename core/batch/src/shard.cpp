#include "shard.hpp"

#include "archive.hpp"
#include "messages.hpp"

#include <foam/base/error.hpp>
#include <foam/base/internal/files.hpp>

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <sys/stat.h>
#include <unistd.h>

namespace foam::inline batch {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::seconds flush_interval{5};
constexpr std::size_t most_pending = 8 << 20;

[[noreturn]] void fail_writing(const fs::path& file) {
    throw Error(ErrorCode::output, fmt::format("{}: it cannot be written ({})", file.string(), std::strerror(errno)));
}

struct flock whole_file() {
    struct flock whole {};
    whole.l_type = F_WRLCK;
    whole.l_whence = SEEK_SET;
    return whole;
}

/// Locks the open file for this process, also on network file systems. Returns whether it could, or another process has
/// it.
bool lock(int descriptor, const fs::path& file) {
    struct flock whole = whole_file();
    if (fcntl(descriptor, F_OFD_SETLK, &whole) == 0) {
        return true;
    }
    if (errno != EAGAIN && errno != EACCES) {
        throw Error(ErrorCode::output,
                    fmt::format("{}: it cannot be locked ({}); remedy: a file system with locks for --run-dir",
                                file.string(), std::strerror(errno)));
    }
    return false;
}

/// The results in a file that count: of items of the shard whose files have not changed since.
struct ValidResults {
    std::set<std::string> done;
    std::string lines;
    std::size_t failed = 0;
    std::size_t whole = 0;  ///< bytes up to the end of the last whole frame
    bool all_lines = true; ///< every line counts
};

/// Returns whether the item's file has another content than that of a digest. A file that cannot be read has not.
bool has_changed(const BatchItem& item, const Digest& digest, Archives& archives) {
    try {
        const auto inside = archive_path(item.path);
        return !digest.empty() &&
               digest_of(inside ? archives.at(inside->archive).read(inside->member) : read_file(item.path)) != digest;
    } catch (const Error&) {
        return false;
    }
}

ValidResults valid_results(const Plan& plan, std::size_t shard, std::string_view bytes) {
    std::map<std::string_view, const BatchItem*> items;
    for (const BatchItem* item : plan.items_of(shard)) {
        items[item->id] = item;
    }
    Archives archives;
    ValidResults valid;
    valid.whole = for_each_line(bytes, [&](std::string_view line) {
        ResultHead head = head_of(line);
        const auto item = items.find(head.id);
        if (item == items.end() || has_changed(*item->second, head.digest, archives)) {
            valid.all_lines = false;
            return;
        }
        valid.failed += head.failed ? 1 : 0;
        valid.done.insert(std::move(head.id));
        valid.lines.append(line) += '\n';
    });
    return valid;
}

/// Returns whether the file of a finished shard has a result for each item as it is now.
bool is_whole(const Plan& plan, std::size_t shard, const fs::path& file) {
    const std::string bytes = read_file(file);
    const ValidResults valid = valid_results(plan, shard, bytes);
    return valid.whole == bytes.size() && valid.done.size() == plan.items_of(shard).size();
}

/// Returns whether the name still means the open file: another process may have finished the shard meanwhile.
bool is_still(int descriptor, const fs::path& file) {
    struct stat open {
    }, named{};
    return fstat(descriptor, &open) == 0 && stat(file.c_str(), &named) == 0 && open.st_ino == named.st_ino &&
           open.st_dev == named.st_dev;
}

} // namespace

OpenShard::OpenShard(int descriptor, fs::path file) : descriptor_(descriptor), file_(std::move(file)) {}

OpenShard::~OpenShard() {
    ::close(descriptor_);
}

std::unique_ptr<OpenShard> OpenShard::open(const Plan& plan, std::size_t shard, bool& busy) {
    const fs::path file = plan.shard_file(shard), part = part_of(file);
    busy = false;
    if (fs::exists(file)) {
        if (is_whole(plan, shard, file)) {
            return nullptr;
        }
        std::error_code taken; // by another process that found the same
        fs::rename(file, part, taken);
    }
    const int descriptor = ::open(part.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (descriptor < 0) {
        fail_writing(part);
    }
    std::unique_ptr<OpenShard> opened(new OpenShard(descriptor, file));
    if (!lock(descriptor, part)) {
        busy = true;
        return nullptr;
    }
    if (!is_still(descriptor, part)) {
        return nullptr; // finished between the two calls
    }
    if (fs::exists(file)) { // finished before this process made the part again
        fs::remove(part);
        return nullptr;
    }
    opened->read_results(plan, shard);
    return opened;
}

void OpenShard::read_results(const Plan& plan, std::size_t shard) {
    const fs::path part = part_of(file_);
    ValidResults valid = valid_results(plan, shard, read_file(part));
    const std::set<std::string>& done = valid.done;
    failed_before_ = valid.failed;
    done_before_ = done.size();
    for (const BatchItem* item : plan.items_of(shard)) {
        if (!done.contains(item->id)) {
            left_.push_back(item);
        }
    }
    const std::size_t kept = valid.all_lines ? valid.whole : 0;
    if (ftruncate(descriptor_, static_cast<off_t>(kept)) != 0 || lseek(descriptor_, 0, SEEK_END) < 0) {
        fail_writing(part);
    }
    if (!valid.all_lines) {
        pending_ = std::move(valid.lines);
        flush();
    }
}

void OpenShard::add(std::string_view line) {
    pending_.append(line);
    pending_ += '\n';
    ++added_;
    if (pending_.size() > most_pending) {
        flush();
    }
}

void OpenShard::flush() {
    flushed_ = std::chrono::steady_clock::now();
    if (pending_.empty()) {
        return;
    }
    const std::string frame = frame_of(pending_);
    for (std::size_t done = 0; done < frame.size();) {
        const ssize_t n = write(descriptor_, frame.data() + done, frame.size() - done);
        if (n < 0 && errno != EINTR) {
            fail_writing(part_of(file_));
        }
        done += n > 0 ? static_cast<std::size_t>(n) : 0;
    }
    pending_.clear();
}

bool OpenShard::flush_due() const {
    return !pending_.empty() && std::chrono::steady_clock::now() - flushed_ > flush_interval;
}

void OpenShard::finish() {
    flush();
    if (fsync(descriptor_) != 0 || std::rename(part_of(file_).c_str(), file_.c_str()) != 0) {
        fail_writing(file_);
    }
}

bool is_worked_on(const Plan& plan, std::size_t shard) {
    const int descriptor = ::open(part_of(plan.shard_file(shard)).c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0) {
        return false;
    }
    struct flock other = whole_file();
    const bool locked = fcntl(descriptor, F_OFD_GETLK, &other) == 0 && other.l_type != F_UNLCK;
    ::close(descriptor);
    return locked;
}

bool for_each_result(const Plan& plan, std::size_t shard, const std::function<void(std::string_view)>& on_line) {
    const fs::path file = plan.shard_file(shard), part = part_of(file);
    if (fs::exists(file)) {
        std::size_t lines = 0;
        for_each_line_of(file, [&](std::string_view line) {
            ++lines;
            on_line(line);
        });
        return lines == plan.items_of(shard).size();
    }
    std::ifstream stream(part, std::ios::binary); // another process may be writing the next frame
    for_each_line(std::string(std::istreambuf_iterator<char>(stream), {}), on_line);
    return false;
}

} // namespace foam::batch
