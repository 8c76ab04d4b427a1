// The check of a contract, promise by promise. The first breach of each is kept.
#pragma once

#include <foam/runtime/contract.hpp>

#include <fmt/format.h>

#include <stdexcept>

namespace foam::inline runtime {

/// A broken promise. The message has the place, the failure, and the remedy.
class Breach : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

class Promises {
public:
    Promises(std::string stage, const ContractOptions& options) : stage_(std::move(stage)), options_(options) {}

    /// Checks a promise. `look` throws Breach; any other exception is a breach too.
    void check(const std::string& promise, const std::function<void()>& look);
    std::vector<ContractFinding> findings;

private:
    std::string stage_;
    const ContractOptions& options_;
};

inline void require(bool kept, const std::string& message) {
    if (!kept) {
        throw Breach(message);
    }
}

/// A context with a request to stop.
class Stopped final : public QuietContext {
public:
    bool cancelled() const override { return true; }
};

/// Requires that `call` with a Stopped context ends by Error(cancelled).
void require_stop(const std::function<void(Context&)>& call);
/// Runs `call` with that many threads for parallel_for.
void with_threads(std::size_t threads, const std::function<void()>& call);

void check_spherizer(const Spherizer& spherizer, const StageInfo& info, Promises& promises);
/// Checks for each objective that its figure is less than with the other objectives.
void check_objectives(const RegisteredStage& stage, const Registry& registry, Promises& promises);
void check_mesh_filter(const MeshFilter& filter, Promises& promises);
void check_mesh_loader(const MeshLoader& loader, const StageInfo& info, const ContractOptions& options,
                       Promises& promises);
void check_writer(const Writer& writer, const StageInfo& info, Promises& promises);
void check_refiner(const Refiner& refiner, Promises& promises);
void check_model_reader(const ModelReader& reader, const ContractOptions& options, Promises& promises);

} // namespace foam::runtime
