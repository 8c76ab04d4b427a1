#include "journal.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <tuple>

namespace foam {
namespace {

const char* to_string(Event::Kind kind) {
    switch (kind) {
    case Event::Kind::run_started:
        return "run_started";
    case Event::Kind::input_loaded:
        return "input_loaded";
    case Event::Kind::task_started:
        return "task_started";
    case Event::Kind::task_finished:
        return "task_finished";
    case Event::Kind::progress:
        return "progress";
    case Event::Kind::finding:
        return "finding";
    case Event::Kind::run_finished:
        return "run_finished";
    }
    return "";
}

const char* to_string(Severity severity) {
    switch (severity) {
    case Severity::debug:
        return "debug";
    case Severity::info:
        return "info";
    case Severity::warning:
        return "warning";
    case Severity::error:
        return "error";
    }
    return "";
}

std::string json_line(const Event& event) {
    nlohmann::ordered_json line;
    line["event"] = to_string(event.kind);
    line["seconds"] = event.seconds;
    if (!event.link.empty()) {
        line["link"] = event.link;
    }
    if (!event.stage.empty()) {
        line["stage"] = event.stage;
    }
    if (event.kind == Event::Kind::task_finished) {
        line["duration"] = event.duration;
        line["cached"] = event.cached;
    }
    if (!event.message.empty()) {
        line["severity"] = to_string(event.severity);
        line["message"] = event.message;
    }
    return line.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

} // namespace

Observer::~Observer() = default;

Journal::Journal(Observer* observer) : observer_(observer) {}

double Journal::seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

double Journal::done_share(double running) {
    if (expected_ > 0) {
        shown_ =
            std::max(shown_, std::min(1.0, (static_cast<double>(done_) + running) / static_cast<double>(expected_)));
    }
    return shown_;
}

void Journal::deliver(Event event) {
    event.seconds = seconds();
    if (event.kind != Event::Kind::progress) {
        events_ += json_line(event);
    }
    if (observer_) {
        observer_->on(event);
    }
}

void Journal::expect(std::size_t tasks) {
    const std::lock_guard lock(mutex_);
    expected_ += tasks;
}

void Journal::started(const std::string& link, const std::string& stage) {
    const std::lock_guard lock(mutex_);
    Event event;
    event.kind = Event::Kind::task_started;
    event.link = link;
    event.stage = stage;
    event.done = done_share(0);
    deliver(std::move(event));
}

void Journal::finished(const std::string& link, const StageReport& report) {
    const std::lock_guard lock(mutex_);
    ++done_;
    Event event;
    event.kind = Event::Kind::task_finished;
    event.link = link;
    event.stage = report.stage;
    event.duration = report.seconds;
    event.cached = report.cached;
    event.done = done_share(0);
    deliver(std::move(event));
}

void Journal::progress(const std::string& link, const std::string& stage, double fraction) {
    const std::lock_guard lock(mutex_);
    Event event;
    event.link = link;
    event.stage = stage;
    event.done = done_share(std::clamp(fraction, 0.0, 1.0));
    deliver(std::move(event));
}

void Journal::finding(Finding finding) {
    const std::lock_guard lock(mutex_);
    Event event;
    event.kind = Event::Kind::finding;
    event.link = finding.link;
    event.stage = finding.stage;
    event.severity = finding.severity;
    event.message = finding.message;
    event.done = done_share(0);
    findings_.push_back(std::move(finding));
    deliver(std::move(event));
}

void Journal::repeat(const StageLog& log, const std::string& link, const std::string& stage) {
    for (const Finding& said : log.findings) {
        finding({said.severity, link, stage, said.message});
    }
}

void Journal::emit(Event::Kind kind, const std::string& message) {
    const std::lock_guard lock(mutex_);
    Event event;
    event.kind = kind;
    event.message = message;
    event.done = kind == Event::Kind::run_finished ? 1 : done_share(0);
    deliver(std::move(event));
}

std::vector<Finding> Journal::findings() const {
    const std::lock_guard lock(mutex_);
    std::vector<Finding> sorted = findings_;
    std::sort(sorted.begin(), sorted.end(), [](const Finding& a, const Finding& b) {
        return std::tie(a.link, a.stage, a.severity, a.message) < std::tie(b.link, b.stage, b.severity, b.message);
    });
    return sorted;
}

std::string Journal::events_jsonl() const {
    const std::lock_guard lock(mutex_);
    return events_;
}

StageContext::StageContext(Journal& journal, std::string link, std::string stage, std::uint64_t seed,
                           std::function<bool()> cancelled)
    : journal_(journal), link_(std::move(link)), stage_(std::move(stage)), seed_(seed),
      cancelled_(std::move(cancelled)) {}

void StageContext::progress(double fraction) {
    journal_.progress(link_, stage_, fraction);
}

void StageContext::log(Severity severity, std::string_view message) {
    const Finding finding{severity, link_, stage_, std::string(message)};
    {
        const std::lock_guard lock(mutex_);
        findings_.push_back(finding);
    }
    journal_.finding(finding);
}

void StageContext::metric(std::string_view name, double value, std::string_view unit) {
    const std::lock_guard lock(mutex_);
    metrics_[std::string(name)] = {std::string(name), value, std::string(unit)};
}

StageLog StageContext::said() const {
    const std::lock_guard lock(mutex_);
    StageLog log;
    log.findings = findings_;
    for (const auto& [name, metric] : metrics_) {
        log.metrics.push_back(metric);
    }
    return log;
}

} // namespace foam
