#include "statistics.hpp"

#include <cmath>
#include <limits>

namespace foam::inline bench {

namespace {

bool answered(const EngineAnswer& answer) {
    return answer.state == EngineAnswer::State::answered;
}

} // namespace

void Mean::add(double value) {
    ++count_;
    const double deviation = value - mean_;
    mean_ += deviation / static_cast<double>(count_);
    squares_ += deviation * (value - mean_);
}

double Mean::value() const {
    return count_ > 0 ? mean_ : std::numeric_limits<double>::quiet_NaN();
}

double Mean::error() const {
    const auto n = static_cast<double>(count_);
    return count_ > 1 ? std::sqrt(squares_ / (n - 1) / n) : std::numeric_limits<double>::quiet_NaN();
}

void Paired::add(double of_original, double of_spheres) {
    original.add(of_original);
    spheres.add(of_spheres);
    difference.add(of_spheres - of_original);
}

void Verdicts::add(bool of_original, bool of_spheres) {
    holds[0] += of_original ? 1 : 0;
    holds[1] += of_spheres ? 1 : 0;
    only_original += of_original && !of_spheres ? 1 : 0;
    only_spheres += of_spheres && !of_original ? 1 : 0;
    difference.add((of_spheres ? 1 : 0) - (of_original ? 1 : 0));
}

EngineComparison compare_models(const std::vector<std::array<EngineAnswer, 2>>& answers) {
    EngineComparison result;
    for (const auto& both : answers) {
        for (std::size_t m = 0; m < both.size(); ++m) {
            result.aborted[m] += both[m].state == EngineAnswer::State::aborted ? 1 : 0;
        }
        const auto& [original, spheres] = both;
        if (!answered(original) || !answered(spheres)) {
            const auto left = EngineAnswer::State::not_asked;
            result.not_asked += original.state == left || spheres.state == left ? 1 : 0;
            continue;
        }
        result.move.add(original.move_seconds, spheres.move_seconds);
        result.collision.add(original.move_seconds + original.collision_seconds,
                             spheres.move_seconds + spheres.collision_seconds);
        result.collides.add(original.collides(), spheres.collides());
        result.hits_obstacle.add(original.hits_obstacle, spheres.hits_obstacle);
        result.hits_itself.add(original.hits_itself, spheres.hits_itself);
        if (!std::isnan(original.distance) && !std::isnan(spheres.distance)) {
            result.distance.add(original.move_seconds + original.distance_seconds,
                                spheres.move_seconds + spheres.distance_seconds);
            if (!original.collides() && !spheres.collides() && std::isfinite(original.distance + spheres.distance)) {
                result.metres.add(original.distance, spheres.distance);
            }
        }
    }
    return result;
}

Missed missed_by(const std::vector<std::array<EngineAnswer, 2>>& answers,
                 const std::vector<std::array<EngineAnswer, 2>>& exact) {
    Missed result;
    for (std::size_t q = 0; q < answers.size() && q < exact.size(); ++q) {
        const EngineAnswer &spheres = answers[q][1], &original = exact[q][0];
        if (answered(spheres) && answered(original)) {
            result.obstacle_hits += original.hits_obstacle ? 1 : 0;
            result.obstacles += original.hits_obstacle && !spheres.hits_obstacle ? 1 : 0;
            result.self_hits += original.hits_itself ? 1 : 0;
            result.selves += original.hits_itself && !spheres.hits_itself ? 1 : 0;
        }
    }
    return result;
}

} // namespace foam::bench
