#include "workspace.hpp"

#include <fmt/format.h>

#include <new>

namespace foam {

Error described(std::exception_ptr thrown, const std::string& stage, const std::string& link,
                const std::string& input) {
    std::string where = fmt::format("stage '{}'", stage);
    if (!link.empty()) {
        where += fmt::format(", link '{}'", link);
    }
    if (!input.empty()) {
        where += fmt::format(", input '{}'", input);
    }
    try {
        std::rethrow_exception(thrown);
    } catch (const Error& error) {
        if (error.code() == ErrorCode::cancelled) {
            return error;
        }
        return {error.code(), fmt::format("{}: {}", where, error.what())};
    } catch (const std::bad_alloc&) {
        return {ErrorCode::geometry, fmt::format("{}: not enough memory", where)};
    } catch (const std::exception& error) {
        return {ErrorCode::plugin,
                fmt::format("{}: the stage failed with an exception of its own: {}", where, error.what())};
    } catch (...) {
        return {ErrorCode::plugin, fmt::format("{}: the stage threw something that is no std::exception", where)};
    }
}

} // namespace foam
