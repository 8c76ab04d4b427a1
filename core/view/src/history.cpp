#include "session_work.hpp"

namespace foam::inline view {

Change History::difference(std::size_t from, std::size_t model) const {
    Change change{
        .model = model, .links = {}, .state = {}, .version = version_, .can_undo = can_undo(), .can_redo = can_redo()};
    for (std::size_t m = 0; m < states_[from].size(); ++m) {
        const ModelState &before = states_[from][m], &after = now()[m];
        for (std::size_t l = 0; l < before.size(); ++l) {
            if (before[l] != after[l]) {
                change.model = m;
                change.links.push_back(l);
            }
        }
    }
    change.state = now()[change.model];
    return change;
}

Change History::change(std::size_t model, ModelState state) {
    states_.resize(at_ + 1);
    states_.push_back(states_.back());
    states_.back()[model] = std::move(state);
    if (states_.size() > deepest) {
        states_.erase(states_.begin());
    }
    at_ = states_.size() - 1;
    ++version_;
    return difference(at_ - 1, model);
}

Change History::undo() {
    --at_;
    ++version_;
    return difference(at_ + 1, 0);
}

Change History::redo() {
    ++at_;
    ++version_;
    return difference(at_ - 1, 0);
}

} // namespace foam::inline view
