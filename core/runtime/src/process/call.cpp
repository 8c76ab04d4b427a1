#include "process/process.hpp"

#include <foam/runtime/internal/bytes.hpp>

#include <exception>
#include <new>
#include <stdexcept>

namespace foam::inline runtime {
namespace {

constexpr std::string_view magic_of_calls = "foam stage call 2\n";

void put_value(std::string& out, const ParameterValue& value) {
    put(out, static_cast<std::uint8_t>(value.index()));
    std::visit(
        [&](const auto& v) {
            if constexpr (std::is_same_v<std::decay_t<decltype(v)>, std::string>) {
                put_text(out, v);
            } else {
                put(out, v);
            }
        },
        value);
}

ParameterValue take_value(ByteReader& in) {
    switch (in.take<std::uint8_t>()) {
    case 0:
        return in.take<bool>();
    case 1:
        return in.take<std::int64_t>();
    case 2:
        return in.take<double>();
    default:
        return in.take_text();
    }
}

void put_solid(std::string& out, const Solid& solid) {
    put(out, static_cast<std::uint64_t>(solid.parts().size()));
    for (const Solid::Part& part : solid.parts()) {
        put(out, part.pose);
        put(out, part.covers);
        put(out, part.primitive.has_value());
        if (part.primitive) {
            put_element(out, *part.primitive);
        } else {
            put_mesh(out, *part.mesh);
        }
    }
}

std::shared_ptr<const Solid> take_solid(ByteReader& in) {
    std::vector<Solid::Part> parts;
    for (auto count = in.take<std::uint64_t>(); count > 0 && in.good(); --count) {
        Solid::Part& part = parts.emplace_back();
        part.pose = in.take<Pose>();
        part.covers = in.take<Covers>();
        if (in.take<bool>()) {
            part.primitive = take_element(in);
        } else {
            part.mesh = std::make_shared<const Mesh>(take_mesh(in));
        }
    }
    return Solid::make(std::move(parts));
}

void put_budget(std::string& out, const Budget& budget) {
    put(out, budget.max_spheres.has_value());
    put(out, static_cast<std::uint64_t>(budget.max_spheres.value_or(0)));
    put(out, budget.max_protrusion.has_value());
    put(out, budget.max_protrusion.value_or(0));
    put(out, budget.guarantee);
    put(out, budget.max_cost.has_value());
    put(out, budget.max_cost.value_or(0));
    put(out, budget.cost);
}

Budget take_budget(ByteReader& in) {
    Budget budget;
    const bool spheres = in.take<bool>();
    const auto most = in.take<std::uint64_t>();
    const bool protrusion = in.take<bool>();
    const auto limit = in.take<double>();
    budget.max_spheres = spheres ? std::optional<std::size_t>(most) : std::nullopt;
    budget.max_protrusion = protrusion ? std::optional(limit) : std::nullopt;
    budget.guarantee = in.take<Guarantee>();
    const bool priced = in.take<bool>();
    const auto cost = in.take<double>();
    budget.max_cost = priced ? std::optional(cost) : std::nullopt;
    budget.cost = in.take<ElementCost>();
    return budget;
}

} // namespace

std::string to_bytes(const StageRequest& request) {
    std::string out(magic_of_calls);
    put(out, request.what);
    put(out, request.parent);
    put(out, request.threads);
    put(out, request.memory_limit);
    put_text(out, request.plugin);
    put(out, static_cast<std::uint64_t>(request.used.size()));
    for (const std::string& file : request.used) {
        put_text(out, file);
    }
    put_text(out, request.stage);
    put(out, static_cast<std::uint64_t>(request.given.size()));
    for (const auto& [name, value] : request.given) {
        put_text(out, name);
        put_value(out, value);
    }
    put(out, request.seed);
    put_text(out, request.work);
    return out;
}

StageRequest request_from(std::string_view bytes) {
    StageRequest request;
    const bool begins_well = bytes.starts_with(magic_of_calls);
    ByteReader in(begins_well ? bytes.substr(magic_of_calls.size()) : std::string_view());
    request.what = in.take<StageRequest::What>();
    request.parent = in.take<std::int64_t>();
    request.threads = in.take<std::uint64_t>();
    request.memory_limit = in.take<std::uint64_t>();
    request.plugin = in.take_text();
    for (auto count = in.take<std::uint64_t>(); count > 0 && in.good(); --count) {
        request.used.push_back(in.take_text());
    }
    request.stage = in.take_text();
    for (auto count = in.take<std::uint64_t>(); count > 0 && in.good(); --count) {
        std::string name = in.take_text();
        request.given.emplace(std::move(name), take_value(in));
    }
    request.seed = in.take<std::uint64_t>();
    request.work = in.take_text();
    if (!in.good() || !in.at_end()) {
        throw Error(ErrorCode::internal, "the request of a stage call is damaged");
    }
    return request;
}

void put_shape_work(std::string& out, const Shape& shape, std::span<const Budget> budgets) {
    put(out, static_cast<std::uint64_t>(budgets.size()));
    for (const Budget& budget : budgets) {
        put_budget(out, budget);
    }
    put_text(out, shape.name());
    put_solid(out, shape.original());
    const bool one = &shape.processed() == &shape.original();
    put(out, one);
    if (!one) {
        put_solid(out, shape.processed());
    }
}

ShapeCall shape_call_from(std::string_view bytes) {
    ByteReader in(bytes);
    std::vector<Budget> budgets;
    for (auto count = in.take<std::uint64_t>(); count > 0 && in.good(); --count) {
        budgets.push_back(take_budget(in));
    }
    std::string name = in.take_text();
    const auto original = take_solid(in);
    const auto processed = in.take<bool>() ? original : take_solid(in);
    if (!in.good() || !in.at_end()) {
        throw Error(ErrorCode::internal, "the shape of a stage call is damaged");
    }
    return {Shape(std::move(name), processed, original), std::move(budgets)};
}

std::string error_answer(std::exception_ptr thrown) {
    std::string out(1, static_cast<char>(Answer::error));
    try {
        std::rethrow_exception(thrown);
    } catch (const Error& error) {
        put(out, Thrown::error);
        put(out, error.code());
        out += error.what();
    } catch (const std::bad_alloc&) {
        put(out, Thrown::bad_alloc);
    } catch (const std::exception& error) {
        put(out, Thrown::exception);
        out += error.what();
    } catch (...) {
        put(out, Thrown::other);
    }
    return out;
}

void rethrow_answer(std::string_view rest) {
    struct Other {};
    ByteReader in(rest);
    switch (in.take<Thrown>()) {
    case Thrown::error: {
        const auto code = in.take<ErrorCode>();
        throw Error(code, std::string(rest.substr(sizeof(Thrown) + sizeof code)));
    }
    case Thrown::bad_alloc:
        throw std::bad_alloc();
    case Thrown::exception:
        throw std::runtime_error(std::string(rest.substr(sizeof(Thrown))));
    default:
        throw Other{};
    }
}

} // namespace foam::runtime
