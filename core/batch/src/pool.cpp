#include "pool.hpp"

#include <foam/base/error.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

namespace foam::inline batch {
namespace {

void write_line(int descriptor, const std::string& line) {
    const std::string bytes = line + '\n';
    for (std::size_t done = 0; done < bytes.size();) {
        const ssize_t n = write(descriptor, bytes.data() + done, bytes.size() - done);
        if (n < 0 && errno != EINTR) {
            return; // the worker has ended, which its answers show
        }
        done += n > 0 ? static_cast<std::size_t>(n) : 0;
    }
}

} // namespace

Pool::Pool(PoolOptions options) : options_(std::move(options)), workers_(options_.workers) {
    std::signal(SIGPIPE, SIG_IGN); // a worker may end while it is given a mesh
}

Pool::Worker::Worker(const PoolOptions& options) : errors(memory_file(""), "a file in memory"), since(Clock::now()) {
    process = std::make_unique<ChildProcess>(options.program, worker_command, requests.reading.value(),
                                             answers.writing.value(), errors.value());
    requests.reading.close();
    answers.writing.close();
    fcntl(answers.reading.value(), F_SETFL, O_NONBLOCK);
    write_line(requests.writing.value(), line_of(options.task));
}

void Pool::Worker::give(Job next) {
    // Child and parent share the place in the file: both begin again.
    if (ftruncate(errors.value(), 0) == 0) {
        lseek(errors.value(), 0, SEEK_SET);
    }
    since = Clock::now();
    write_line(requests.writing.value(), request_line(next.item(), next.one_search));
    job = std::move(next);
}

void Pool::Worker::receive() {
    std::array<char, 65536> chunk;
    for (;;) {
        const ssize_t n = read(answers.reading.value(), chunk.data(), chunk.size());
        if (n > 0) {
            received.append(chunk.data(), static_cast<std::size_t>(n));
        } else if (n == 0 || errno != EINTR) {
            return;
        }
    }
}

std::optional<std::string> Pool::Worker::line() {
    const std::size_t end = received.find('\n');
    if (end == std::string::npos) {
        return {};
    }
    std::string result = received.substr(0, end);
    received.erase(0, end + 1);
    return result;
}

std::string Pool::Worker::last_words() const {
    std::array<char, 4096> text;
    const ssize_t n = pread(errors.value(), text.data(), text.size(), 0);
    std::string_view words(text.data(), n > 0 ? static_cast<std::size_t>(n) : 0);
    for (const std::string_view before : {"\n", "foam: "}) {
        words.remove_prefix(words.starts_with(before) ? before.size() : 0);
    }
    words = words.substr(0, words.find('\n'));
    return std::string(words.substr(0, words.find(", input '"))); // where a member of an archive was unpacked differs
}

void Pool::turn(const std::function<std::optional<Job>()>& next, const Done& done) {
    for (std::unique_ptr<Worker>& worker : workers_) {
        if (worker && worker->job) {
            continue;
        }
        std::optional<Job> job;
        if (!waiting_.empty()) {
            job = std::move(waiting_.back());
            waiting_.pop_back();
        } else {
            job = next();
        }
        if (!job) {
            break;
        }
        if (!worker) {
            worker = std::make_unique<Worker>(options_);
        }
        worker->give(std::move(*job));
    }
    wait();
    for (std::unique_ptr<Worker>& worker : workers_) {
        if (worker && worker->job) {
            read_answers(worker, done);
        }
    }
}

void Pool::wait() {
    std::vector<pollfd> ready;
    for (const std::unique_ptr<Worker>& worker : workers_) {
        if (worker && worker->job) {
            ready.push_back({worker->answers.reading.value(), POLLIN, 0});
        }
    }
    constexpr int tick = 50; // ms
    poll(ready.data(), ready.size(), ready.empty() ? 0 : tick);
}

void Pool::read_answers(std::unique_ptr<Worker>& worker, const Done& done) {
    const bool ended = worker->process->ended(); // asked first: everything that it wrote is in the pipe
    worker->receive();
    while (const std::optional<std::string> line = worker->line()) {
        take_line(*worker, *line, done);
    }
    if (ended) {
        end_of(worker, done);
    } else if (worker->job &&
               std::chrono::duration<double>(Clock::now() - worker->since).count() > options_.time_limit) {
        const Job job = *worker->job;
        worker.reset(); // ends it
        finish_item(job,
                    failure_line(job.item(), options_.task.recipe_digest, "", "time limit",
                                 fmt::format("the time limit of {:g} s a mesh is over; remedy: --time-limit",
                                             options_.time_limit),
                                 options_.time_limit),
                    done);
    }
}

void Pool::take_line(Worker& worker, const std::string& line, const Done& done) {
    if (!worker.ready) { // its first line says so; starting is no part of a mesh's time
        worker.ready = true;
        worker.since = Clock::now();
        return;
    }
    if (!worker.job) {
        return; // a plugin's, not an answer
    }
    Job job = std::move(*worker.job);
    worker.job.reset();
    done(job, line);
    job.again = false;
    if (++job.at < job.items.size()) {
        worker.give(std::move(job));
    }
}

void Pool::finish_item(Job job, const std::string& line, const Done& done) {
    done(job, line);
    job.again = false;
    if (++job.at < job.items.size()) {
        waiting_.push_back(std::move(job));
    }
}

void Pool::end_of(std::unique_ptr<Worker>& worker, const Done& done) {
    const ChildEnd end = worker->process->end();
    const std::string words = worker->last_words();
    const bool ready = worker->ready;
    std::optional<Job> job = std::move(worker->job);
    worker.reset();
    const std::string how =
        end.why == ChildEnd::Why::signalled ? signal_text(end.number) : fmt::format("exit code {}", end.number);
    if (!ready && end.why == ChildEnd::Why::exited && end.number == exit_code(ErrorCode::usage)) {
        throw Error(ErrorCode::internal, fmt::format("a worker cannot start: {}", words));
    }
    if (!job) {
        return;
    }
    if (!job->again) { // the crash may be another program's doing
        job->again = true;
        waiting_.push_back(std::move(*job));
        return;
    }
    const std::string line =
        failure_line(job->item(), options_.task.recipe_digest, "", "crash",
                     fmt::format("its process ended twice ({}){}{}", how, words.empty() ? "" : ": ", words), 0);
    finish_item(std::move(*job), line, done);
}

bool Pool::idle() const {
    return waiting_.empty() &&
           std::none_of(workers_.begin(), workers_.end(), [](const auto& w) { return w && w->job; });
}

} // namespace foam::batch
