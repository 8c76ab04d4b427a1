#include <foam/runtime/internal/journal.hpp>

#include <nlohmann/json.hpp>
#include <sys/resource.h>

#include <algorithm>
#include <tuple>

namespace foam::inline runtime {
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

/// Returns the CPU time of this process and of the children of isolated stages, s.
double cpu_of_process() {
    const auto seconds = [](const timeval& t) {
        return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    double sum = 0;
    for (const auto who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
        rusage usage{};
        getrusage(who, &usage);
        sum += seconds(usage.ru_utime) + seconds(usage.ru_stime);
    }
    return sum;
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

Journal::Journal(Observer* observer) : observer_(observer), cpu_start_(cpu_of_process()) {}

double Journal::seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

double Journal::cpu_seconds() const {
    return cpu_of_process() - cpu_start_;
}

void Journal::plan(std::vector<PhaseWeight> phases) {
    const std::lock_guard lock(mutex_);
    plan_ = std::move(phases);
    phase_ = plan_.size();
}

void Journal::end_phase() {
    if (!current_.phase.empty()) {
        phases_.push_back({current_.phase, seconds() - current_.seconds, cpu_seconds() - current_.cpu_seconds});
    }
}

void Journal::begin(const std::string& phase) {
    const std::lock_guard lock(mutex_);
    end_phase();
    current_ = {phase, seconds(), cpu_seconds()};
    const auto planned =
        std::find_if(plan_.begin(), plan_.end(), [&](const PhaseWeight& other) { return other.phase == phase; });
    phase_ = static_cast<std::size_t>(planned - plan_.begin());
    expected_ = done_ = 0;
    rounds_ = 0;
}

Journal::Times Journal::times() const {
    const std::lock_guard lock(mutex_);
    Times times{phases_, seconds(), cpu_seconds()};
    RunPhase other{"other", times.seconds, times.cpu_seconds};
    if (!current_.phase.empty()) {
        times.phases.push_back(
            {current_.phase, times.seconds - current_.seconds, times.cpu_seconds - current_.cpu_seconds});
    }
    for (const RunPhase& phase : times.phases) {
        other.seconds -= phase.seconds;
        other.cpu_seconds -= phase.cpu_seconds;
    }
    times.phases.push_back(std::move(other));
    return times;
}

/// Returns the finished share of the phase: of its tasks, or of the part that remained after earlier rounds.
double Journal::phase_share(double running) const {
    if (expected_ == 0 || phase_ >= plan_.size()) {
        return rounds_;
    }
    const double tasks = std::min(1.0, (static_cast<double>(done_) + running) / static_cast<double>(expected_));
    constexpr double part_of_a_round = 0.2;
    return plan_[phase_].countable ? tasks : rounds_ + part_of_a_round * (1 - rounds_) * tasks;
}

double Journal::done_share(double running) {
    double before = 0, all = 0;
    for (std::size_t i = 0; i < plan_.size(); ++i) {
        before += i < phase_ ? plan_[i].weight : 0;
        all += plan_[i].weight;
    }
    if (phase_ < plan_.size()) {
        constexpr double most = 0.99; // after the last phase there is some work that is not counted
        shown_ = std::max(shown_, std::min(most, (before + plan_[phase_].weight * phase_share(running)) / all));
    }
    return shown_;
}

std::optional<double> Journal::seconds_left(double running) const {
    if (phase_ >= plan_.size() || !plan_[phase_].countable) {
        return std::nullopt;
    }
    const double share = phase_share(running), passed = seconds() - current_.seconds;
    if (share < 0.05 || passed < 0.5) {
        return std::nullopt;
    }
    double later = 0;
    for (std::size_t i = phase_ + 1; i < plan_.size(); ++i) {
        later += plan_[i].weight;
    }
    if (later > plan_[phase_].weight) { // the time of this phase does not predict that of the later ones
        return std::nullopt;
    }
    return passed / share * (1 - share + later / plan_[phase_].weight);
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

void Journal::round(double share) {
    const std::lock_guard lock(mutex_);
    rounds_ = std::max(share, phase_share(0));
    expected_ = done_ = 0;
}

void Journal::started(const std::string& link, const std::string& stage) {
    const std::lock_guard lock(mutex_);
    Event event;
    event.kind = Event::Kind::task_started;
    event.link = link;
    event.stage = stage;
    event.done = done_share(0);
    event.seconds_left = seconds_left(0);
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
    event.seconds_left = seconds_left(0);
    deliver(std::move(event));
}

void Journal::progress(const std::string& link, const std::string& stage, double fraction) {
    const std::lock_guard lock(mutex_);
    Event event;
    event.link = link;
    event.stage = stage;
    event.done = done_share(std::clamp(fraction, 0.0, 1.0));
    event.seconds_left = seconds_left(std::clamp(fraction, 0.0, 1.0));
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
    for (const Finding& kept : log.findings) {
        finding({kept.severity, link, stage, kept.message});
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

StageLog StageContext::kept_log() const {
    const std::lock_guard lock(mutex_);
    StageLog log;
    log.findings = findings_;
    for (const auto& [name, metric] : metrics_) {
        log.metrics.push_back(metric);
    }
    return log;
}

} // namespace foam::runtime
