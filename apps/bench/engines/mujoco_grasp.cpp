// Many simulations of one scene in MuJoCo, side by side on all threads: a robot follows position commands to grasp an
// object. Reads a request as JSON from standard input, answers as JSON in one message on descriptor 3, or on standard
// output if that is not open. Keys: python/foam/bench/kinds/throughput.py.
#include "mujoco_model.hpp"

#include <nlohmann/json.hpp>

#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <fcntl.h>
#include <iostream>
#include <iterator>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace {

using nlohmann::json;

int id_of(const mjModel* model, int kind, const std::string& name) {
    const int id = mj_name2id(model, kind, name.c_str());
    if (id < 0) {
        throw std::runtime_error("the scene has no '" + name + "'");
    }
    return id;
}

/// Commands at some times, linear in between.
struct Motion {
    std::vector<double> times; ///< s, ascending
    std::vector<std::vector<double>> controls;

    void command(double time, double* control) const {
        const auto next = std::upper_bound(times.begin(), times.end(), time);
        const std::size_t b = std::min(static_cast<std::size_t>(next - times.begin()), times.size() - 1);
        const std::size_t a = b == 0 ? 0 : b - 1;
        const double span = times[b] - times[a];
        const double share = span > 0 ? std::clamp((time - times[a]) / span, 0.0, 1.0) : 1.0;
        for (std::size_t i = 0; i < controls[a].size(); ++i) {
            control[i] = controls[a][i] + share * (controls[b][i] - controls[a][i]);
        }
    }
};

/// CPU seconds of this process, over all threads.
double cpu_seconds() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    const auto seconds = [](const timeval& t) {
        return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

/// What became of one simulation.
struct Ending {
    std::uint64_t contacts = 0; ///< over all steps
    int grip = 0;               ///< contacts between fingers and object at the end
    bool both_fingers = false;  ///< both touch it at the end
    double lift = 0;            ///< m; how much higher the object is at the end than at the beginning
    int warnings = 0;
};

class Simulations {
public:
    explicit Simulations(const json& request) : model_(foam::mujoco::compiled(request.at("scene"))) {
        object_ = id_of(model_.get(), mjOBJ_BODY, request.at("object"));
        for (const json& finger : request.at("fingers")) {
            fingers_.push_back(id_of(model_.get(), mjOBJ_BODY, finger));
        }
        for (const json& moment : request.at("motion")) {
            motion_.times.push_back(moment.at("time"));
            motion_.controls.push_back(moment.at("controls"));
            if (motion_.controls.back().size() != static_cast<std::size_t>(model_->nu)) {
                throw std::runtime_error("the motion has another number of controls than the scene");
            }
        }
        steps_ = request.at("steps");
        const std::vector<double> start = request.at("start");
        if (start.size() > static_cast<std::size_t>(model_->nq)) {
            throw std::runtime_error("the start has more values than the scene has positions");
        }
        for (const json& offset : request.at("offsets")) {
            start_one(start, offset);
        }
    }

    /// Every step of every simulation; a thread takes the next one that nobody has taken.
    void run(unsigned threads) {
        std::atomic<std::size_t> next{0};
        std::vector<std::thread> workers;
        for (unsigned t = 0; t < threads; ++t) {
            workers.emplace_back([&] {
                for (std::size_t i = next++; i < data_.size(); i = next++) {
                    simulate(i);
                }
            });
        }
        for (std::thread& worker : workers) {
            worker.join();
        }
    }

    std::uint64_t steps() const { return static_cast<std::uint64_t>(steps_) * data_.size(); }
    const mjModel& model() const { return *model_; }

    json endings() {
        json result = json::array();
        for (std::size_t i = 0; i < data_.size(); ++i) {
            const Ending ending = ending_of(i);
            result.push_back({{"contacts", ending.contacts},
                              {"grip", ending.grip},
                              {"both_fingers", ending.both_fingers},
                              {"lift_m", ending.lift},
                              {"warnings", ending.warnings}});
        }
        return result;
    }

private:
    /// `offset`: of the object in the plane, m.
    void start_one(const std::vector<double>& start, const std::vector<double>& offset) {
        data_.emplace_back(mj_makeData(model_.get()));
        mjData* data = data_.back().get();
        std::copy(start.begin(), start.end(), data->qpos);
        double* object = data->qpos + model_->jnt_qposadr[model_->body_jntadr[object_]];
        object[0] += offset.at(0);
        object[1] += offset.at(1);
        height_.push_back(object[2]);
        contacts_.push_back(0);
        mj_forward(model_.get(), data);
    }

    void simulate(std::size_t i) {
        mjData* data = data_[i].get();
        for (int step = 0; step < steps_; ++step) {
            motion_.command(data->time, data->ctrl);
            mj_step(model_.get(), data);
            contacts_[i] += static_cast<std::uint64_t>(data->ncon);
        }
    }

    Ending ending_of(std::size_t i) {
        const mjData* data = data_[i].get();
        Ending ending{.contacts = contacts_[i]};
        std::vector<bool> touched(fingers_.size(), false);
        for (int c = 0; c < data->ncon; ++c) {
            const int a = model_->geom_bodyid[data->contact[c].geom1], b = model_->geom_bodyid[data->contact[c].geom2];
            for (std::size_t f = 0; f < fingers_.size(); ++f) {
                if ((a == object_ && b == fingers_[f]) || (b == object_ && a == fingers_[f])) {
                    touched[f] = true;
                    ++ending.grip;
                }
            }
        }
        ending.both_fingers = std::all_of(touched.begin(), touched.end(), [](bool t) { return t; });
        ending.lift = data->qpos[model_->jnt_qposadr[model_->body_jntadr[object_]] + 2] - height_[i];
        for (const mjWarningStat& warning : data->warning) {
            ending.warnings += warning.number;
        }
        return ending;
    }

    foam::mujoco::Model model_;
    std::vector<foam::mujoco::Data> data_;
    std::vector<double> height_;
    std::vector<std::uint64_t> contacts_;
    Motion motion_;
    std::vector<int> fingers_;
    int object_ = 0, steps_ = 0;
};

json answer_to(const json& request) {
    Simulations simulations(request);
    const auto begin = std::chrono::steady_clock::now();
    const double cpu_begin = cpu_seconds();
    simulations.run(request.at("threads"));
    const double cpu = cpu_seconds() - cpu_begin;
    const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return {{"version", std::string("MuJoCo ") + mj_versionString()},
            {"steps", simulations.steps()},
            {"wall_s", wall},
            {"cpu_s", cpu},
            {"geoms", simulations.model().ngeom},
            {"simulations", simulations.endings()}};
}

void send(const std::string& text) {
    constexpr int answer_descriptor = 3;
    if (fcntl(answer_descriptor, F_GETFD) < 0) {
        std::cout << text << '\n';
        return;
    }
    const std::uint64_t size = text.size();
    std::string message(reinterpret_cast<const char*>(&size), sizeof size);
    message += text;
    for (std::size_t done = 0; done < message.size();) {
        const ssize_t n = write(answer_descriptor, message.data() + done, message.size() - done);
        if (n <= 0) {
            return; // nobody listens any more
        }
        done += static_cast<std::size_t>(n);
    }
}

} // namespace

int main() {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    // Neither a log file in the current folder nor exit(): an error is an exception like others.
    mju_user_warning = [](const char*) {};
    mju_user_error = [](const char* text) { throw std::runtime_error(std::string("MuJoCo: ") + text); };
    try {
        const std::string text{std::istreambuf_iterator<char>(std::cin), {}};
        send(answer_to(json::parse(text)).dump());
        return 0;
    } catch (const std::exception& error) {
        send(json{{"error", error.what()}}.dump());
        return 1;
    }
}
