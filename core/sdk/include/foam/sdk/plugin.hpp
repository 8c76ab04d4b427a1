// The interface of a plugin. A whole plugin:
//
//     #include <foam/sdk/plugin.hpp>
//     class Mine final : public foam::Spherizer { public: explicit Mine(const foam::Parameters&); … };
//     FOAM_PLUGIN("spherize_mine", "1.0", "Apache-2.0") {
//         enrol.add<Mine>({.name = "spherize.mine", .summary = "…", .parameters = {…}});
//     }
//
// The binary interface is a C envelope with C++ inside; it requires an exact match of compiler library, ABI epoch and
// sanitizers. An ELF note holds the fingerprint. It is read before dlopen, since opening a mismatched library can abort
// the process. Only plain data and core's own classes cross the interface.
#pragma once

#include <foam/sdk/abi.hpp>
#include <foam/sdk/stage.hpp>

#include <concepts>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>

namespace foam {
inline namespace [[gnu::visibility("default")]] sdk {

/// Makes the stages that StageInfo::uses names, for the constructor of a stage that uses them.
class StageMaker {
public:
    virtual ~StageMaker();
    /// Returns the stage; null if no plugin has it. Throws Error(plugin) for a stage that `uses` does not name or that
    /// itself uses others, Error(usage) for another kind or bad parameters.
    template <std::derived_from<Stage> T>
    std::unique_ptr<T> make(std::string_view stage,
                            const std::map<std::string, ParameterValue>& parameters = {}) const {
        return std::unique_ptr<T>(static_cast<T*>(make_stage(stage, T::kind, parameters).release()));
    }

protected:
    virtual std::unique_ptr<Stage> make_stage(std::string_view stage, StageKind kind,
                                              const std::map<std::string, ParameterValue>& parameters) const = 0;
};

using StageFactory = std::function<std::unique_ptr<Stage>(const Parameters&, const StageMaker&)>;

/// Collects the stages of one plugin. The registry accepts all of them or none.
class Enrolment {
public:
    virtual ~Enrolment();
    virtual void add_stage(StageKind kind, StageInfo info, StageFactory factory) = 0;

    /// Adds a stage T, which is constructible from Parameters and StageMaker, from Parameters, or from nothing.
    template <std::derived_from<Stage> T> void add(StageInfo info) {
        add_stage(T::kind, std::move(info),
                  []([[maybe_unused]] const Parameters& parameters,
                     [[maybe_unused]] const StageMaker& maker) -> std::unique_ptr<Stage> {
                      if constexpr (std::constructible_from<T, const Parameters&, const StageMaker&>) {
                          return std::make_unique<T>(parameters, maker);
                      } else if constexpr (std::constructible_from<T, const Parameters&>) {
                          return std::make_unique<T>(parameters);
                      } else {
                          return std::make_unique<T>();
                      }
                  });
    }
};

} // namespace sdk
} // namespace foam

extern "C" {
/// The C envelope that foam_plugin_v1() returns. `size` and `epoch` come first and never move.
struct foam_plugin_envelope_v1 {
    std::uint32_t size;
    std::uint32_t epoch;
    const char* fingerprint;
    const char* name;
    const char* version;
    const char* license;
    void (*enrol)(foam::Enrolment&);
};
}

#define FOAM_PLUGIN(plugin_name, plugin_version, plugin_license)                                                       \
    static void foam_plugin_enrol(foam::Enrolment& enrol);                                                             \
    FOAM_ABI_NOTE                                                                                                      \
    extern "C" __attribute__((visibility("default"))) const foam_plugin_envelope_v1* foam_plugin_v1() {                \
        static const foam_plugin_envelope_v1 envelope{sizeof(foam_plugin_envelope_v1),                                 \
                                                      FOAM_ABI_EPOCH,                                                  \
                                                      FOAM_ABI_FINGERPRINT,                                            \
                                                      plugin_name,                                                     \
                                                      plugin_version,                                                  \
                                                      plugin_license,                                                  \
                                                      &foam_plugin_enrol};                                             \
        return &envelope;                                                                                              \
    }                                                                                                                  \
    static void foam_plugin_enrol([[maybe_unused]] foam::Enrolment& enrol)
