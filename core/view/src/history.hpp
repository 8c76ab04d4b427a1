// The states of a session's models, with the way back.
#pragma once

#include <foam/view/session.hpp>

#include <vector>

namespace foam::inline view {

class History {
public:
    explicit History(std::vector<ModelState> begin) : states_{std::move(begin)} {}

    const std::vector<ModelState>& now() const { return states_[at_]; }
    std::size_t version() const { return version_; }
    bool can_undo() const { return at_ > 0; }
    bool can_redo() const { return at_ + 1 < states_.size(); }
    /// Replaces a model; what was undone before is forgotten. Returns what changed.
    Change change(std::size_t model, ModelState state);
    /// Precondition: can_undo(), can_redo().
    Change undo();
    Change redo();

private:
    static constexpr std::size_t deepest = 1000; ///< states share the links that did not change

    /// Returns what changed from the state `from` to the present one. `model`: the answer if nothing did.
    Change difference(std::size_t from, std::size_t model) const;

    std::vector<std::vector<ModelState>> states_;
    std::size_t at_ = 0, version_ = 0;
};

} // namespace foam::inline view
