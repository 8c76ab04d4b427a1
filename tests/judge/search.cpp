#include "search.hpp"

#include <algorithm>

namespace judge {
namespace {

constexpr int lattice_steps = 8; // their half: the middles of edges

struct Place {
    Real s, t;
};

/// The nearest place of the piece, or almost.
Place within(const Patch& patch, Place place) {
    place = {std::clamp<Real>(place.s, 0, 1), std::clamp<Real>(place.t, 0, 1)};
    const Real over = patch.triangle ? (place.s + place.t - 1) / 2 : 0;
    return over > 0 ? Place{std::clamp<Real>(place.s - over, 0, 1), std::clamp<Real>(place.t - over, 0, 1)} : place;
}

/// Steps to the best of eight places around as long as that is farther out, else shorter ones (pattern search: Hooke,
/// Jeeves 1961). The star is turned from step to step, since ridges between elements run in any direction.
void climb(Search& search, const Patch& patch, Place place, Real out) {
    constexpr int directions = 8, most_rounds = 120;
    Real step = 0.5L / lattice_steps, turn = 0;
    for (int round = 0; round < most_rounds && step > nudge && out > -16 * step * patch.reach; ++round) {
        turn += 2.399963229728653L; // the golden angle
        Place best = place;
        Real best_out = out;
        for (int k = 0; k < directions; ++k) {
            const Real angle = turn + k * 0.7853981633974483L;
            const Place next = within(patch, {place.s + step * std::cos(angle), place.t + step * std::sin(angle)});
            if (const Real next_out = search.ask(patch.at(next.s, next.t)); next_out > best_out) {
                best = next;
                best_out = next_out;
            }
        }
        step = best_out > out ? step : step / 2;
        place = best;
        out = best_out;
    }
}

} // namespace

Search::Search(const std::vector<Body>& elements, Real rounding) : rounding_(rounding) {
    for (const Body& element : elements) {
        elements_.push_back(&element);
    }
}

Search Search::near(const Point& middle, Real reach) const {
    const Real apart = (2 + 1e-9L) * reach;
    std::vector<Real> depths;
    Real nearest = std::numeric_limits<Real>::infinity();
    for (const Body* element : elements_) {
        depths.push_back(depth(*element, middle, nearest + apart));
        nearest = std::min(nearest, depths.back());
    }
    Search result = *this;
    result.elements_.clear();
    result.worst_.reset();
    for (std::size_t i = 0; i < depths.size(); ++i) {
        if (depths[i] <= nearest + apart) {
            result.elements_.push_back(elements_[i]);
        }
    }
    return result;
}

Real Search::ask(const Point& p) {
    Real out = std::numeric_limits<Real>::infinity();
    const Real length_of_p = length(p);
    for (const Body* element : elements_) {
        const Real own = rounding_ + own_rounding(*element, length_of_p);
        out = std::min(out, depth(*element, p, out + own) - own);
    }
    if (out > 0 && (!worst_ || out > worst_->distance)) {
        worst_ = Objection{p, out};
    }
    return out;
}

void Search::ask(const Search& other) {
    if (other.worst_ && (!worst_ || other.worst_->distance > worst_->distance)) {
        worst_ = other.worst_;
    }
}

void ask_patch(Search& search, const Patch& patch) {
    constexpr int n = lattice_steps;
    constexpr Real nothing = -std::numeric_limits<Real>::infinity();
    std::array<std::array<Real, n + 3>, n + 3> outs; // with a border
    for (auto& row : outs) {
        row.fill(nothing);
    }
    const auto place = [](int i, int j) { return Place{static_cast<Real>(i) / n, static_cast<Real>(j) / n}; };
    for (int i = 0; i <= n; ++i) {
        for (int j = 0; j <= (patch.triangle ? n - i : n); ++j) {
            outs[i + 1][j + 1] = search.ask(patch.at(place(i, j).s, place(i, j).t));
        }
    }
    for (int i = 0; i <= n; ++i) {
        for (int j = 0; j <= (patch.triangle ? n - i : n); ++j) {
            const Real out = outs[i + 1][j + 1];
            const auto beside = {outs[i][j + 1],     outs[i + 2][j + 1], outs[i + 1][j],
                                 outs[i + 1][j + 2], outs[i][j + 2],     outs[i + 2][j]};
            if (std::all_of(beside.begin(), beside.end(), [&](Real other) { return out >= other; })) {
                climb(search, patch, place(i, j), out);
            }
        }
    }
}

} // namespace judge
