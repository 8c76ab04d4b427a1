// The one exception type that foam throws on purpose.
#pragma once

#include <stdexcept>
#include <string>

namespace foam {
inline namespace [[gnu::visibility("default")]] base {

/// The kind of failure, coarse enough to decide the exit code; see exit_code().
enum class ErrorCode {
    usage,     ///< wrong command line or API call
    recipe,    ///< the recipe is wrong; carries file:line:column in the message
    plugin,    ///< a plugin cannot be loaded or broke its contract
    input,     ///< a file cannot be read, or has other contents than expected
    geometry,  ///< a stage cannot do its work on this geometry
    output,    ///< a result cannot be written
    internal,  ///< an internal check failed: a bug in foam
    cancelled, ///< the user stopped the run
};

const char* to_string(ErrorCode code);
/// Returns 1 if a stage failed, 2 for recipe or usage, 3 for a plugin, 130 if cancelled.
int exit_code(ErrorCode code);

/// An error with a code. The message names the thing (file, link, stage), the reason and the remedy.
class Error : public std::runtime_error {
public:
    Error(ErrorCode code, const std::string& message);
    Error(const Error&);
    Error& operator=(const Error&) = delete;
    ~Error() override;
    ErrorCode code() const noexcept { return code_; }

private:
    ErrorCode code_;
};

} // namespace base
} // namespace foam
