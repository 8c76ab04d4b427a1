// Tables of element_checks.
#include "element_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace foam::inline bench::experiment {
namespace {

double median(std::vector<double> values) {
    if (values.empty()) {
        return std::numeric_limits<double>::quiet_NaN();
    }
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

template <class Quantity> double median_of(const EngineReport& report, Quantity&& quantity) {
    std::vector<double> values;
    for (const auto& both : report.answers) {
        for (const EngineAnswer& answer : both) {
            if (answer.state == EngineAnswer::State::answered) {
                values.push_back(quantity(answer));
            }
        }
    }
    return median(std::move(values));
}

double share_in_contact(const EngineReport& report) {
    double sum = 0, count = 0;
    for (const auto& both : report.answers) {
        for (const EngineAnswer& answer : both) {
            count += answer.state == EngineAnswer::State::answered ? 1 : 0;
            sum += answer.hits_itself ? 1 : 0;
        }
    }
    return sum / count;
}

/// The times of an engine on a model, and of the first method with as many elements a link on the same robot.
struct Times {
    double pair = 0, whole = 0; ///< s
    double pair_ratio = 0, whole_ratio = 0;
};

Times times_of(const ElementCheckResults& results, const ElementCase& of, std::size_t engine) {
    const auto first = std::find_if(results.cases.begin(), results.cases.end(), [&](const ElementCase& other) {
        return other.robot == of.robot && other.each == of.each;
    });
    const auto pair = [&](const ElementCase& one) {
        return check_seconds(one.reports[engine].near) / static_cast<double>(results.pairs);
    };
    const auto whole = [&](const ElementCase& one) { return whole_seconds(one.reports[engine].whole); };
    return {pair(of), whole(of), pair(of) / pair(*first), whole(of) / whole(*first)};
}

std::vector<std::string> methods_of(const ElementCheckResults& results) {
    std::vector<std::string> methods;
    for (const ElementCase& one : results.cases) {
        if (std::find(methods.begin(), methods.end(), one.method) == methods.end()) {
            methods.push_back(one.method);
        }
    }
    return methods;
}

/// The median of a quantity of the times over all robots and numbers of elements, by method and engine.
template <class Quantity> Table summary(const ElementCheckResults& results, Quantity&& quantity) {
    Table table{{"method", "cost by default"}, {}};
    for (const std::string& engine : results.engines) {
        table.columns.emplace_back(find_engine(engine).label);
    }
    for (const std::string& method : methods_of(results)) {
        std::vector<double> prices;
        std::vector<std::vector<double>> values(results.engines.size());
        for (const ElementCase& one : results.cases) {
            if (one.method == method) {
                prices.push_back(one.price);
                for (std::size_t e = 0; e < values.size(); ++e) {
                    values[e].push_back(quantity(times_of(results, one, e)));
                }
            }
        }
        std::vector<std::string> row{method, short_number(median(prices))};
        for (std::vector<double>& of_engine : values) {
            row.push_back(short_number(median(std::move(of_engine))));
        }
        table.rows.push_back(std::move(row));
    }
    return table;
}

Table all_times(const ElementCheckResults& results) {
    Table table{{"robot", "method", "elements", "pairs"}, {}};
    for (const std::string& engine : results.engines) {
        table.columns.push_back(fmt::format("{}: a near pair, ns", find_engine(engine).label));
        table.columns.push_back(fmt::format("{}: the robot, µs", find_engine(engine).label));
    }
    for (const ElementCase& one : results.cases) {
        std::vector<std::string> row{one.robot, one.method, std::to_string(one.elements),
                                     std::to_string(one.shape_pairs)};
        for (std::size_t e = 0; e < results.engines.size(); ++e) {
            const Times times = times_of(results, one, e);
            row.push_back(short_number(1e9 * times.pair));
            row.push_back(short_number(1e6 * times.whole));
        }
        table.rows.push_back(std::move(row));
    }
    return table;
}

Table case_table(const ElementCheckResults& results) {
    Table table{{"robot", "method", "elements_per_link", "elements", "pairs", "mean_cost", "engine", "version",
                 "near_pair_ns", "near_pair_ratio", "robot_us", "robot_ratio", "near_pairs_in_contact",
                 "poses_in_contact", "remark"},
                {}};
    const auto number = [](double value) { return std::isfinite(value) ? fmt::format("{:.4g}", value) : ""; };
    for (const ElementCase& one : results.cases) {
        for (std::size_t e = 0; e < results.engines.size(); ++e) {
            const Times times = times_of(results, one, e);
            const auto& [near, whole] = one.reports[e];
            table.rows.push_back({one.robot, one.method, std::to_string(one.each), std::to_string(one.elements),
                                  std::to_string(one.shape_pairs), number(one.price), results.engines[e], near.version,
                                  number(1e9 * times.pair), number(times.pair_ratio), number(1e6 * times.whole),
                                  number(times.whole_ratio), number(share_in_contact(near)),
                                  number(share_in_contact(whole)), near.error.empty() ? whole.error : near.error});
        }
    }
    return table;
}

std::string introduction(const ElementCheckResults& results) {
    std::string text = fmt::format(
        "A *near pair* is two elements of the model in random poses: they do not touch, but the axis-aligned boxes "
        "around them overlap, so that no broad phase drops them. {} such pairs are checked at once, in {} "
        "arrangements. The check of *the robot* looks at every pair of links but neighbours, in {} random "
        "configurations, does not stop at the first contact, and includes the movement of the links. All times are "
        "medians of CPU time on one thread, and include what the library does around the test of two shapes. Libraries "
        "know no swept boxes: they check the hull that foam writes for them; FCL takes "
        "hulls as its convex shapes. The cost by default is what `--cost` counts for such elements.",
        results.pairs, results.poses, results.poses);
    if (!results.missing.empty()) {
        text += fmt::format(" Left out, as no candidate is here: {}.", fmt::join(results.missing, ", "));
    }
    for (std::size_t e = 0; e < results.engines.size(); ++e) {
        if (const std::string& error = results.cases.front().reports[e].near.error; !error.empty()) {
            text += fmt::format(" {} is not measured: {}.", find_engine(results.engines[e]).label, error);
        }
    }
    return text;
}

} // namespace

double check_seconds(const EngineReport& report) {
    return median_of(report, [](const EngineAnswer& answer) { return answer.collision_seconds; });
}

double whole_seconds(const EngineReport& report) {
    return median_of(report, [](const EngineAnswer& answer) { return answer.move_seconds + answer.collision_seconds; });
}

Outcome told(const ElementCheckResults& results) {
    const std::string first = results.cases.front().method;
    Outcome outcome;
    outcome.cases = case_table(results);
    outcome.sections.push_back({"", introduction(results), "", {}});
    outcome.sections.push_back({"A near pair",
                                fmt::format("In multiples of {}; median over robots and numbers of "
                                            "elements.",
                                            first),
                                "", summary(results, [](const Times& times) { return times.pair_ratio; })});
    outcome.sections.push_back({"The robot against itself",
                                fmt::format("In multiples of {} with as many elements a "
                                            "link.",
                                            first),
                                "", summary(results, [](const Times& times) { return times.whole_ratio; })});
    outcome.sections.push_back({"All times", "", "", all_times(results)});
    return outcome;
}

} // namespace foam::bench::experiment
