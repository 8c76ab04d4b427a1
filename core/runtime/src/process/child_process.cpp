#include <foam/runtime/internal/child.hpp>

#include <foam/base/error.hpp>
#include <foam/runtime/process.hpp>

#include <fmt/format.h>

#include <fcntl.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <string>

namespace foam::inline runtime {
namespace {

std::atomic<std::size_t> running{0};

// Process groups of the children, where a signal handler can read them. If more children than this run at once, the
// others survive a sudden end of the program until the kernel sees that their parent is gone.
std::array<std::atomic<pid_t>, 256> process_groups;

void remember(pid_t group) {
    for (auto& slot : process_groups) {
        pid_t none = 0;
        if (slot.compare_exchange_strong(none, group)) {
            return;
        }
    }
}

void forget(pid_t group) {
    for (auto& slot : process_groups) {
        pid_t expected = group;
        if (slot.compare_exchange_strong(expected, 0)) {
            return;
        }
    }
}

[[noreturn]] void fail(const char* what, int error) {
    throw Error(ErrorCode::internal,
                fmt::format("no child process: {}: {}", what, std::strerror(error)));
}

struct NewPipe {
    NewPipe() {
        if (pipe2(ends, O_CLOEXEC) != 0) {
            fail("a pipe", errno);
        }
    }
    int ends[2] = {-1, -1};
};

} // namespace

Pipe::Pipe() : Pipe(NewPipe().ends) {}

Pipe::Pipe(const int (&ends)[2]) : reading(ends[0], "a pipe"), writing(ends[1], "a pipe") {}

Descriptor::Descriptor(int descriptor, const char* what) {
    if (descriptor < 0) {
        fail(what, errno);
    }
    value_ = fcntl(descriptor, F_DUPFD_CLOEXEC, answer_descriptor + 1);
    const int error = errno;
    ::close(descriptor);
    if (value_ < 0) {
        fail(what, error);
    }
}

Descriptor::~Descriptor() {
    close();
}

void Descriptor::close() {
    if (value_ >= 0) {
        ::close(value_);
        value_ = -1;
    }
}

int memory_file(std::string_view bytes) {
    const int file = memfd_create("foam request", MFD_CLOEXEC);
    for (std::size_t done = 0; file >= 0 && done < bytes.size();) {
        const ssize_t n = write(file, bytes.data() + done, bytes.size() - done);
        if (n < 0 && errno != EINTR) {
            const int error = errno;
            close(file);
            fail("the request", error);
        }
        done += n > 0 ? static_cast<std::size_t>(n) : 0;
    }
    if (file >= 0) {
        lseek(file, 0, SEEK_SET);
    }
    return file;
}

ChildProcess::ChildProcess(const std::filesystem::path& program, const char* command, int request, int answers,
                           int errors) {
    posix_spawn_file_actions_t files;
    posix_spawnattr_t attributes;
    posix_spawn_file_actions_init(&files);
    posix_spawnattr_init(&attributes);
    posix_spawn_file_actions_adddup2(&files, request, STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&files, answers, answer_descriptor);
    posix_spawn_file_actions_adddup2(&files, errors, STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&files, errors, STDERR_FILENO);
    posix_spawn_file_actions_addclosefrom_np(&files, answer_descriptor + 1);
    posix_spawnattr_setpgroup(&attributes, 0);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
    std::string name = program.string(), word = command;
    char* arguments[] = {name.data(), word.data(), nullptr};
    const int error = posix_spawn(&id_, name.c_str(), &files, &attributes, arguments, environ);
    posix_spawn_file_actions_destroy(&files);
    posix_spawnattr_destroy(&attributes);
    if (error != 0) {
        fail(name.c_str(), error);
    }
    ++running;
    remember(id_);
}

ChildProcess::~ChildProcess() {
    kill(-id_, SIGKILL);
    forget(id_);
    while (!status_ && waitpid(id_, nullptr, 0) < 0 && errno == EINTR) {
    }
    --running;
}

bool ChildProcess::ended() {
    int status = 0;
    if (!status_ && waitpid(id_, &status, WNOHANG) != 0) { // ended, or reaped elsewhere
        status_ = status;
    }
    return status_.has_value();
}

ChildEnd ChildProcess::end() const {
    return WIFSIGNALED(*status_) ? ChildEnd{ChildEnd::Why::signalled, WTERMSIG(*status_)}
                                 : ChildEnd{ChildEnd::Why::exited, WEXITSTATUS(*status_)};
}

void begin_child(std::int64_t parent, std::uint64_t mebibytes) {
    std::signal(SIGINT, SIG_IGN);
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) { // the parent had died already: nobody reads the answer
        _exit(1);
    }
    if (mebibytes > 0) { // private memory only, so that the code of libraries does not count
        const rlimit limit{mebibytes << 20, mebibytes << 20};
        setrlimit(RLIMIT_DATA, &limit);
    }
    const rlimit no_core{0, 0}; // the crash is reported; a stage that crashes on every link would fill the disk
    setrlimit(RLIMIT_CORE, &no_core);
}

void end_children() {
    for (const auto& slot : process_groups) {
        if (const pid_t group = slot.load(); group > 0) {
            kill(-group, SIGKILL);
        }
    }
}

std::size_t running_children() {
    return running.load(std::memory_order_relaxed);
}

} // namespace foam::runtime
