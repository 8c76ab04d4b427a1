#include "fit_programme.hpp"

#include <Eigen/Cholesky>

#include <cmath>
#include <limits>

namespace foam::inline search::convex {
namespace {

using Columns = Eigen::Matrix<double, most_variables, Eigen::Dynamic, 0, most_variables, most_variables>;
using Small = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most_variables, 1>;

class Active {
public:
    /// Returns the part of a slope in the span of the active ones, as their multiples.
    Small multiples(const Variables& slope) const {
        const Columns n = columns();
        return (n.transpose() * n).ldlt().solve(n.transpose() * slope);
    }
    Columns columns() const {
        Columns n(most_variables, static_cast<Eigen::Index>(slopes_.size()));
        for (std::size_t i = 0; i < slopes_.size(); ++i) {
            n.col(static_cast<Eigen::Index>(i)) = slopes_[i];
        }
        return n;
    }
    bool empty() const { return slopes_.empty(); }
    bool full() const { return slopes_.size() >= static_cast<std::size_t>(most_variables); }
    void add(const Variables& slope, double price) {
        slopes_.push_back(slope);
        prices_.push_back(price);
    }
    /// The price that becomes 0 first along a step, and the length of the step until then.
    struct Blocking {
        double step = std::numeric_limits<double>::infinity();
        std::size_t index = 0;
    };
    Blocking blocking(const Small& multiples) const {
        Blocking first;
        for (std::size_t i = 0; i < prices_.size(); ++i) {
            if (const double m = multiples(static_cast<Eigen::Index>(i)); m > 1e-12 && prices_[i] / m < first.step) {
                first = {prices_[i] / m, i};
            }
        }
        return first;
    }
    void lower(const Small& multiples, double step) {
        for (std::size_t i = 0; i < prices_.size(); ++i) {
            prices_[i] -= step * multiples(static_cast<Eigen::Index>(i));
        }
    }
    void drop(std::size_t i) {
        slopes_.erase(slopes_.begin() + static_cast<std::ptrdiff_t>(i));
        prices_.erase(prices_.begin() + static_cast<std::ptrdiff_t>(i));
    }

private:
    std::vector<Variables> slopes_;
    std::vector<double> prices_;
};

/// Makes one constraint active. Returns false if none of the steps keeps it with the others.
bool enter(const Constraint& entering, double damping, Active& active, Variables& step) {
    double price = 0;
    for (int round = 0; round < 4 * most_variables; ++round) {
        const Small multiples = active.empty() ? Small() : active.multiples(entering.slope);
        Variables across = entering.slope;
        if (!active.empty()) {
            across -= active.columns() * multiples;
        }
        const Active::Blocking blocking = active.blocking(multiples);
        const double slope = across.dot(entering.slope);
        const double violation = entering.slope.dot(step) - entering.room;
        const bool moves = slope > 1e-12 * entering.slope.squaredNorm() && !active.full();
        const double whole = moves ? damping * violation / slope : std::numeric_limits<double>::infinity();
        const double length = std::min(whole, blocking.step);
        if (!std::isfinite(length)) {
            return false;
        }
        if (moves) {
            step -= across * (length / damping);
        }
        if (!active.empty()) {
            active.lower(multiples, length);
        }
        price += length;
        if (length == whole) {
            active.add(entering.slope, price);
            return true;
        }
        active.drop(blocking.index);
    }
    return false;
}

} // namespace

Variables quadratic_step(const Variables& gradient, double damping, const std::vector<Constraint>& constraints) {
    constexpr double kept = 1e-11; // violation that counts as none
    Variables step = -gradient / damping;
    Active active;
    for (int round = 0; round < 100; ++round) {
        const Constraint* worst = nullptr;
        double most = kept;
        for (const Constraint& c : constraints) {
            if (const double violation = c.slope.dot(step) - c.room; violation > most) {
                most = violation;
                worst = &c;
            }
        }
        if (!worst) {
            return step;
        }
        if (!enter(*worst, damping, active, step)) {
            break;
        }
    }
    return Variables::Zero();
}

} // namespace foam::inline search::convex
