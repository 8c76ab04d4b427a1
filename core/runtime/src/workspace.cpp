#include <foam/runtime/internal/workspace.hpp>

#include <foam/base/text.hpp>

#include <fmt/format.h>

#include <fcntl.h>
#include <new>
#include <string_view>
#include <sys/stat.h>
#include <unistd.h>

namespace foam::inline runtime {

Calls::Calls(const Registry& all, const RunOptions& o, Journal& j, std::uint64_t s, std::optional<double> time_limit)
    : registry(all), options(o), journal(j), seed(s), limits(std::make_shared<Limits>(o, time_limit, j)) {}

Workspace::Workspace(const Recipe& r, const Registry& all, const RunOptions& o, Journal& j, const Cache& c)
    : Calls(all, o, j, r.seed, o.time_limit ? o.time_limit : r.budget_time_limit), recipe(r), cache(c) {}

Workspace Workspace::in(Phase other) const {
    Workspace result = *this;
    result.phase = other;
    return result;
}

Workspace Workspace::with(const Recipe& other) const {
    Workspace result(other, registry, options, journal, cache);
    result.limits = limits;
    result.phase = phase;
    return result;
}

void Calls::check_cancelled() const {
    if (ended()) {
        throw Error(ErrorCode::cancelled, "cancelled; nothing was written");
    }
}

std::filesystem::path cache_folder(const RunOptions& options) {
    if (options.fresh) {
        return {};
    }
    return options.cache.empty() ? Cache::default_folder() : options.cache;
}

std::string place_of(const std::string& stage, const std::string& link, const std::string& input) {
    std::string place = fmt::format("stage '{}'", stage);
    if (!link.empty()) {
        place += fmt::format(", link '{}'", shown(link));
    }
    if (!input.empty()) {
        place += fmt::format(", input '{}'", shown(input));
    }
    return place;
}

/// Returns the beginning of a text that nobody reads to the end.
static std::string shortened(std::string_view text) {
    constexpr std::size_t most = 2000;
    return text.size() <= most ? std::string(text) : std::string(text.substr(0, most)) + " …";
}

WorkingFolder::WorkingFolder() : descriptor_(open(".", O_PATH | O_DIRECTORY | O_CLOEXEC)) {}

WorkingFolder::~WorkingFolder() {
    if (descriptor_ >= 0) {
        close(descriptor_);
    }
}

void WorkingFolder::require() const {
    struct stat before {
    }, now{};
    if (descriptor_ < 0 || fstat(descriptor_, &before) != 0 ||
        (stat(".", &now) == 0 && now.st_dev == before.st_dev && now.st_ino == before.st_ino)) {
        return;
    }
    if (fchdir(descriptor_) == 0) {
        throw Error(ErrorCode::plugin, "the stage changed the working folder of the program; remedy: absolute paths");
    }
}

Error described(std::exception_ptr thrown, const std::string& stage, const std::string& link,
                const std::string& input) {
    const std::string where = place_of(stage, link, input);
    const std::string outer = place_of(stage, link, "");
    try {
        std::rethrow_exception(thrown);
    } catch (const Error& error) {
        if (error.code() == ErrorCode::cancelled) {
            return error;
        }
        // Messages of loaders begin with the file's name and place; it is not repeated.
        const bool named = !input.empty() && std::string_view(error.what()).starts_with(input);
        return {error.code(), fmt::format("{}: {}", named ? outer : where, shown_lines(error.what()))};
    } catch (const std::bad_alloc&) {
        return {ErrorCode::geometry, fmt::format("{}: not enough memory", where)};
    } catch (const std::exception& error) {
        return {ErrorCode::plugin,
                fmt::format("{}: the stage threw an exception: {}", where, shown_lines(shortened(error.what())))};
    } catch (...) {
        return {ErrorCode::plugin, fmt::format("{}: the stage threw an object that is not a std::exception", where)};
    }
}

} // namespace foam::inline runtime
