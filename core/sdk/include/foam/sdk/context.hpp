// Everything outside its arguments that a running stage may access.
#pragma once

#include <foam/base/random.hpp>
#include <foam/geometry/mesh.hpp>

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] sdk {

enum class Severity { debug, info, warning, error };

/// The context of one stage call, passed to the stage. Its methods are safe to call from parallel_for bodies.
class Context {
public:
    virtual ~Context();

    /// Seed of this call: derived from the recipe's seed and what the call works on, never from time or threads.
    virtual std::uint64_t seed() const = 0;
    /// Returns whether the user has requested to stop.
    virtual bool cancelled() const = 0;
    /// Reports the share of the work done, 0 to 1.
    virtual void progress(double fraction) = 0;
    /// Logs a message for the user. Manifest and event log record it as a finding of this stage and link.
    virtual void log(Severity severity, std::string_view message) = 0;
    /// Reports a figure for manifest and report, e.g. metric("triangles", 1200, "1").
    virtual void metric(std::string_view name, double value, std::string_view unit) = 0;

    /// Throws Error(cancelled) if cancelled(). Call it in loops that may take more than a tenth of a second.
    void check_cancelled() const;
    /// Returns a separate generator for each purpose.
    Random random(std::string_view purpose) const { return Random(derive_seed(seed(), purpose)); }
};

/// A context that is never cancelled and discards all messages: for tests and in-process use.
class QuietContext : public Context {
public:
    explicit QuietContext(std::uint64_t seed = 0);
    ~QuietContext() override;
    std::uint64_t seed() const override;
    bool cancelled() const override;
    void progress(double fraction) override;
    void log(Severity severity, std::string_view message) override;
    void metric(std::string_view name, double value, std::string_view unit) override;

private:
    std::uint64_t seed_;
};

/// A base class of mesh loaders that know the colours of triangles, beside MeshLoader.
class MeshColours {
public:
    virtual ~MeshColours();
    MeshColours(const MeshColours&) = delete;
    MeshColours& operator=(const MeshColours&) = delete;
    /// Returns a colour 0xRRGGBBAA for each triangle of load(), in its order; 0 where the file has none, or only a
    /// texture. Empty: the file has no colours. Throws as load() does.
    virtual std::vector<std::uint32_t> colours(const std::filesystem::path& file, Context& context) const = 0;

protected:
    MeshColours();
};

} // namespace sdk
} // namespace foam
