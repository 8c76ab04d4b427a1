// A context that keeps what stages say.
#pragma once

#include <foam/sdk/registry.hpp>

#include <string>
#include <vector>

namespace foam::test {

/// Keeps what a stage says.
class ListeningContext final : public QuietContext {
public:
    void log(Severity, std::string_view message) override { messages.emplace_back(message); }
    std::vector<std::string> messages;
};

} // namespace foam::test
