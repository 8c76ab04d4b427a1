#include "workspace.hpp"

#include <fmt/format.h>

#include <new>
#include <string_view>

namespace foam {

Error described(std::exception_ptr thrown, const std::string& stage, const std::string& link,
                const std::string& input) {
    std::string where = fmt::format("stage '{}'", stage);
    if (!link.empty()) {
        where += fmt::format(", link '{}'", link);
    }
    const std::string outer = where;
    if (!input.empty()) {
        where += fmt::format(", input '{}'", input);
    }
    try {
        std::rethrow_exception(thrown);
    } catch (const Error& error) {
        if (error.code() == ErrorCode::cancelled) {
            return error;
        }
        // Loaders begin with the file's name and place; once is enough.
        const bool named = !input.empty() && std::string_view(error.what()).starts_with(input);
        return {error.code(), fmt::format("{}: {}", named ? outer : where, error.what())};
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
