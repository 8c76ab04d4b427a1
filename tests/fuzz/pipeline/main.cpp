// pipeline_fuzz: random geometry, recipes and options through whole runs; docs/dev/fuzzing.md.
//   pipeline_fuzz --from SEED --count N [--jobs J] [--limit S] [--memory MIB] [--record FILE]
//                 [--numbers odd|ordinary] [--models spheres|elements]
//   pipeline_fuzz --seeds FILE         the seeds of a list, one a line, "#" begins a comment
//   pipeline_fuzz --seed S [--keep DIR]   one case in this process, for debuggers; its files stay in DIR
// Exit codes: 0 all passed, 1 findings, 2 usage.
#include "workers.hpp"

#include <foam/runtime/process.hpp>

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <stdexcept>

namespace {

namespace fs = std::filesystem;
using namespace foam::fuzz;

struct Arguments {
    std::vector<std::uint64_t> seeds;
    std::optional<std::uint64_t> single;
    fs::path keep, record;
    Limits limits;
};

std::uint64_t number(const std::string& text) {
    return std::stoull(text);
}

std::vector<std::uint64_t> seeds_in(const fs::path& file) {
    std::ifstream stream(file);
    if (!stream) {
        throw std::runtime_error(file.string() + " cannot be read");
    }
    std::vector<std::uint64_t> seeds;
    for (std::string line; std::getline(stream, line);) {
        if (line.find_first_of("0123456789") == 0) {
            seeds.push_back(number(line));
        }
    }
    return seeds;
}

Arguments read_arguments(int count, char** words) {
    Arguments arguments;
    std::uint64_t from = 1, cases = 0;
    for (int i = 1; i + 1 < count; i += 2) {
        const std::string key = words[i], value = words[i + 1];
        if (key == "--from") {
            from = number(value);
        } else if (key == "--count") {
            cases = number(value);
        } else if (key == "--jobs") {
            arguments.limits.jobs = number(value);
        } else if (key == "--limit") {
            arguments.limits.cpu_seconds = std::stod(value);
        } else if (key == "--memory") {
            arguments.limits.memory = number(value);
        } else if (key == "--numbers" && (value == "odd" || value == "ordinary")) {
            arguments.limits.cases.odd_numbers = value == "odd";
        } else if (key == "--models" && (value == "spheres" || value == "elements")) {
            arguments.limits.cases.elements = value == "elements";
        } else if (key == "--record") {
            arguments.record = value;
        } else if (key == "--seeds") {
            arguments.seeds = seeds_in(value);
        } else if (key == "--seed") {
            arguments.single = number(value);
        } else if (key == "--keep") {
            arguments.keep = value;
        } else {
            throw std::runtime_error("unknown argument " + key);
        }
    }
    for (std::uint64_t k = 0; k < cases; ++k) {
        arguments.seeds.push_back(from + k);
    }
    if (count < 3 || count % 2 == 0 || (arguments.seeds.empty() && !arguments.single)) {
        throw std::runtime_error("usage: pipeline_fuzz --from SEED --count N | --seeds FILE | --seed S [--keep DIR]");
    }
    return arguments;
}

/// Made on construction, removed with all in it on destruction.
class Scratch {
public:
    Scratch() {
        std::string name = (fs::temp_directory_path() / "foam-pipeline-XXXXXX").string();
        if (!mkdtemp(name.data())) {
            throw std::runtime_error("cannot make a temporary folder");
        }
        path_ = name;
    }
    ~Scratch() {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }
    const fs::path& path() const { return path_; }

private:
    fs::path path_;
};

/// One line, without what could steer a terminal.
std::string line_of(std::string text) {
    for (char& c : text) {
        c = static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    }
    return text.substr(0, 500);
}

/// A refusal without names and numbers: equal ones are counted together.
std::string kind_of(const std::string& end) {
    std::string kind;
    bool quoted = false, number = false;
    for (const char c : end) {
        const bool digit = (c >= '0' && c <= '9') || (number && (c == '.' || c == 'e' || c == '-' || c == '+'));
        if (!quoted && !(digit && number)) {
            kind += digit ? '#' : c;
        }
        number = digit;
        if (c == '\'') {
            quoted = !quoted;
        }
    }
    return kind.substr(0, 200);
}

/// What is told at the end, and goes on record.
class Record {
public:
    explicit Record(const fs::path& file) {
        if (!file.empty()) {
            stream_.open(file);
        }
    }

    void add(std::uint64_t seed, const Outcome& outcome) {
        for (const std::string& finding : outcome.findings) {
            say("seed " + std::to_string(seed) + ": " + line_of(finding) + "  [replay: pipeline_fuzz --seed " +
                std::to_string(seed) + " --keep DIR]");
        }
        ++(outcome.findings.empty() ? passed_ : failed_);
        Share& share = ends_[outcome.end.substr(0, outcome.end.find(':')) +
                             (outcome.spherizer.empty() ? "" : " " + outcome.spherizer)];
        ++share.cases;
        share.seconds += outcome.seconds;
        if (outcome.end.starts_with("refused")) {
            ++refusals_[kind_of(outcome.end)];
        }
        seconds_.push_back(outcome.seconds);
    }

    /// Whether all passed.
    bool end(const std::vector<std::uint64_t>& seeds) {
        std::sort(seconds_.begin(), seconds_.end());
        double sum = 0;
        for (const double s : seconds_) {
            sum += s;
        }
        for (const auto& [end, share] : ends_) {
            say(std::to_string(share.cases) + "  " + (end.empty() ? "(ended its process)" : end) + ", CPU " +
                std::to_string(std::lround(share.seconds)) + " s");
        }
        for (const auto& [kind, count] : refusals_) {
            stream_ << count << "  " << line_of(kind) << "\n";
        }
        char text[200];
        std::snprintf(text, sizeof text, "seeds %llu to %llu; CPU %.0f s, median %.1f ms, longest %.2f s",
                      static_cast<unsigned long long>(seeds.front()), static_cast<unsigned long long>(seeds.back()),
                      sum, 1e3 * seconds_.at(seconds_.size() / 2), seconds_.back());
        say(text);
        say(std::to_string(passed_) + " passed, " + std::to_string(failed_) + " failed");
        return failed_ == 0 && passed_ > 0;
    }

private:
    void say(const std::string& line) {
        std::printf("%s\n", line.c_str());
        std::fflush(stdout);
        if (stream_.is_open()) {
            stream_ << line << std::endl;
        }
    }

    std::ofstream stream_;
    struct Share {
        std::size_t cases = 0;
        double seconds = 0;
    };
    std::size_t passed_ = 0, failed_ = 0;
    std::map<std::string, Share> ends_;
    std::map<std::string, std::size_t> refusals_;
    std::vector<double> seconds_;
};

/// In this process: a debugger sees all of it.
bool replay(const Arguments& arguments, foam::Registry& registry) {
    const Scratch scratch;
    const fs::path folder = arguments.keep.empty() ? scratch.path() / "case" : fs::absolute(arguments.keep);
    const Case made = make_case(*arguments.single, registry, arguments.limits.cases);
    write_case(made, folder);
    std::printf("%s\nthreads %zu%s%s\n", made.files.at("recipe.yaml").c_str(), made.threads,
                made.cached ? ", cached" : "", made.again ? ", run again" : "");
    std::fflush(stdout);
    const Outcome outcome = run_case(made, registry, folder);
    for (const std::string& finding : outcome.findings) {
        std::printf("FINDING: %s\n", finding.c_str());
    }
    std::printf("%s (%.3f s)\n", outcome.end.c_str(), outcome.seconds);
    return outcome.findings.empty();
}

bool run_all(const Arguments& arguments, foam::Registry& registry) {
    const Scratch scratch;
    Record record(arguments.record);
    run_cases(arguments.seeds, registry, scratch.path(), arguments.limits,
              [&](std::uint64_t seed, const Outcome& outcome) { record.add(seed, outcome); });
    return record.end(arguments.seeds);
}

} // namespace

int main(int count, char** words) {
    foam::serve_isolated_call(count, words);
    try {
        const Arguments arguments = read_arguments(count, words);
        foam::Registry registry;
        registry.load_directory(FOAM_FUZZ_PLUGINS);
        return (arguments.single ? replay(arguments, registry) : run_all(arguments, registry)) ? 0 : 1;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "pipeline_fuzz: %s\n", error.what());
        return 2;
    }
}
