#include "grid_search.hpp"

#include <foam/base/parallel.hpp>
#include <foam/geometry/measure.hpp>

#include <algorithm>

namespace foam::spherize_grid {

/// A cell, its ball and its possible divisions, shared by all states that have the cell.
struct Refinement::Part {
    using Division = std::vector<std::shared_ptr<Part>>;

    explicit Part(Cell whole) : cell(std::move(whole)), ball(cell.ball()) {}

    Cell cell;
    Sphere ball;
    std::vector<Division> divisions;
    bool divided = false; // the divisions are known
    double reach = 0;     // of all balls of the divisions and the cell's own ball, from its centre

    void find_divisions() {
        const Cell tight = cell.in_box(cell.extent());
        reach = ball.radius;
        for (int pattern = 1; pattern < 8; ++pattern) {
            Division division;
            for (Cell& piece : tight.divided({pattern & 1 ? 2 : 1, pattern & 2 ? 2 : 1, pattern & 4 ? 2 : 1})) {
                division.push_back(std::make_shared<Part>(std::move(piece)));
                const Sphere& part = division.back()->ball;
                reach = std::max(reach, distance(part.center, ball.center) + part.radius);
            }
            if (division.size() > 1) {
                divisions.push_back(std::move(division));
            }
        }
        divided = true;
    }
};

struct Refinement::Leaf {
    std::shared_ptr<Part> part;
    std::vector<double> saved; // m³ of the union per division, while the neighbouring balls stay; empty: not known
};

/// The leaf to divide and the division.
struct Refinement::Choice {
    std::size_t leaf = 0, division = 0, added = 0;
    double gain = 0; // m³ per additional sphere; zero if there is no choice
};

namespace {

std::vector<Sphere> pieces_of(const auto& division) {
    std::vector<Sphere> balls;
    for (const auto& part : division) {
        balls.push_back(part->ball);
    }
    return balls;
}

} // namespace

Refinement::Refinement(const Grid& start) {
    for (const Cell& cell : start.cells) {
        leaves_.push_back({std::make_shared<Part>(cell), {}});
    }
}

Refinement::~Refinement() = default;

void Refinement::measure(Leaves& leaves) {
    std::vector<Sphere> balls;
    for (const Leaf& leaf : leaves) {
        balls.push_back(leaf.part->ball);
    }
    parallel_for(leaves.size(), [&](std::size_t i) {
        Part& part = *leaves[i].part;
        if (!part.divided) {
            part.find_divisions();
        }
        if (leaves[i].saved.empty()) {
            for (const Part::Division& division : part.divisions) {
                leaves[i].saved.push_back(volume_saved(balls, i, pieces_of(division)));
            }
        }
    });
}

/// Returns the division that saves most per sphere among those that add at most `room` spheres.
Refinement::Choice Refinement::best_choice(const Leaves& leaves, std::size_t room) {
    Choice best;
    for (std::size_t i = 0; i < leaves.size(); ++i) {
        for (std::size_t d = 0; d < leaves[i].saved.size(); ++d) {
            const std::size_t added = leaves[i].part->divisions[d].size() - 1;
            const double gain = leaves[i].saved[d] / static_cast<double>(added);
            if (added <= room && gain > best.gain) {
                best = {i, d, added, gain};
            }
        }
    }
    return best;
}

void Refinement::divide(Leaves& leaves, const Choice& choice) {
    const std::shared_ptr<Part> old = leaves[choice.leaf].part;
    const Part::Division& division = old->divisions[choice.division];
    leaves.erase(leaves.begin() + static_cast<std::ptrdiff_t>(choice.leaf));
    std::vector<Sphere> changed = pieces_of(division);
    changed.push_back(old->ball);
    for (Leaf& leaf : leaves) {
        // The saving of a division depends on the neighbouring balls.
        const auto near = [&](const Sphere& other) {
            return distance(leaf.part->ball.center, other.center) < leaf.part->reach + other.radius;
        };
        if (std::any_of(changed.begin(), changed.end(), near)) {
            leaf.saved.clear();
        }
    }
    for (const std::shared_ptr<Part>& part : division) {
        leaves.push_back({part, {}});
    }
}

Grid Refinement::at(std::size_t most, Context& context) {
    Leaves end;
    const Leaves* state = &leaves_;
    while (state->size() < most) {
        context.check_cancelled();
        Leaves& current = state == &end ? end : leaves_;
        measure(current);
        const std::size_t room = most - current.size();
        Choice choice = best_choice(current, SIZE_MAX);
        if (choice.added > room) {
            // From here on the refinement depends on `most`: the common state is kept.
            if (state != &end) {
                end = leaves_;
                state = &end;
            }
            choice = best_choice(end, room);
        }
        if (choice.gain == 0) {
            break;
        }
        divide(state == &end ? end : leaves_, choice);
    }
    Grid grid;
    for (const Leaf& leaf : *state) {
        grid.cells.push_back(leaf.part->cell);
        grid.balls.push_back(leaf.part->ball);
    }
    grid.volume = union_volume(grid.balls);
    return grid;
}

} // namespace foam::spherize_grid
