#include "engine.hpp"

#include <foam/base/error.hpp>
#include <foam/runtime/internal/bytes.hpp>

namespace foam::inline bench {
namespace {

void put_robot(std::string& out, const EngineRobot& robot) {
    put(out, static_cast<std::uint64_t>(robot.bodies.size()));
    for (const EngineBody& body : robot.bodies) {
        put(out, static_cast<std::uint64_t>(body.size()));
        for (const EngineShape& shape : body) {
            put(out, shape.pose);
            const auto* mesh = std::get_if<std::shared_ptr<const Mesh>>(&shape.geometry);
            put(out, static_cast<std::uint64_t>(mesh != nullptr));
            if (mesh) {
                put_mesh(out, **mesh);
                put(out, static_cast<std::uint64_t>(shape.convex));
            } else {
                put_element(out, std::get<Element>(shape.geometry));
            }
        }
    }
    put_values(out, robot.pairs);
}

EngineRobot take_robot(ByteReader& in) {
    EngineRobot robot;
    for (auto bodies = in.take<std::uint64_t>(); bodies > 0 && in.good(); --bodies) {
        EngineBody& body = robot.bodies.emplace_back();
        for (auto shapes = in.take<std::uint64_t>(); shapes > 0 && in.good(); --shapes) {
            EngineShape& shape = body.emplace_back();
            shape.pose = in.take<Pose>();
            if (in.take<std::uint64_t>() != 0) {
                shape.geometry = std::make_shared<const Mesh>(take_mesh(in));
                shape.convex = in.take<std::uint64_t>() != 0;
            } else {
                shape.geometry = take_element(in);
            }
        }
    }
    robot.pairs = in.take_values<std::array<std::uint32_t, 2>>();
    return robot;
}

} // namespace

std::string to_bytes(const EngineProblem& problem) {
    std::string out;
    put_text(out, problem.engine);
    for (const EngineRobot& model : problem.models) {
        put_robot(out, model);
    }
    put(out, static_cast<std::uint64_t>(problem.environments.size()));
    for (const std::vector<Obstacle>& environment : problem.environments) {
        put(out, static_cast<std::uint64_t>(environment.size()));
        for (const Obstacle& obstacle : environment) {
            put(out, obstacle.pose);
            put_element(out, obstacle.shape);
        }
    }
    put(out, static_cast<std::uint64_t>(problem.queries.size()));
    for (const EngineQuery& query : problem.queries) {
        put(out, query.environment);
        put(out, static_cast<std::uint32_t>(query.distance));
        put_values(out, query.poses);
        put(out, query.self_checks);
    }
    put(out, problem.time_limit);
    put(out, problem.first);
    return out;
}

EngineProblem problem_from_bytes(std::string_view bytes) {
    ByteReader in(bytes);
    EngineProblem problem;
    problem.engine = in.take_text();
    for (EngineRobot& model : problem.models) {
        model = take_robot(in);
    }
    for (auto count = in.take<std::uint64_t>(); count > 0 && in.good(); --count) {
        std::vector<Obstacle>& environment = problem.environments.emplace_back();
        for (auto obstacles = in.take<std::uint64_t>(); obstacles > 0 && in.good(); --obstacles) {
            Obstacle& obstacle = environment.emplace_back();
            obstacle.pose = in.take<Pose>();
            obstacle.shape = take_element(in);
        }
    }
    for (auto count = in.take<std::uint64_t>(); count > 0 && in.good(); --count) {
        EngineQuery& query = problem.queries.emplace_back();
        query.environment = in.take<std::uint32_t>();
        query.distance = in.take<std::uint32_t>() != 0;
        query.poses = in.take_values<Pose>();
        query.self_checks = in.take<std::uint32_t>();
    }
    problem.time_limit = in.take<double>();
    problem.first = in.take<std::uint64_t>();
    bool sound = in.good() && in.at_end() && problem.models[0].bodies.size() == problem.models[1].bodies.size();
    for (const EngineQuery& query : problem.queries) {
        sound = sound && query.environment < problem.environments.size() &&
                query.poses.size() == problem.models[0].bodies.size();
    }
    if (!sound) {
        throw Error(ErrorCode::internal, "the problem for a collision engine cannot be read");
    }
    return problem;
}

} // namespace foam::bench
