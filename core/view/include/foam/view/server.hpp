// The server of a session: on the loopback address, for one page.
#pragma once

#include <foam/view/session.hpp>

#include <cstddef>
#include <functional>
#include <memory>
#include <string>

namespace foam {
inline namespace [[gnu::visibility("default")]] view {

/// Serves a session to the browsers of this computer. Its address has a random token; every request must have it, name
/// the loopback address as its host and, if it names an origin, the server itself; changes must name it.
class Server {
public:
    /// Largest body of a request, bytes.
    static constexpr std::size_t most_body = 1 << 16;

    /// Returns a message as the page shall show it: with "stdin" instead of a temporary file.
    using Wording = std::function<std::string(std::string)>;

    /// Takes a free port of 127.0.0.1, or `port` if it is not 0. The session must outlive the server. `wording`:
    /// of errors; absent: as they are. Throws Error(usage) if the port is taken.
    explicit Server(Session& session, int port = 0, Wording wording = {});
    ~Server();
    Server(const Server&) = delete;
    Server& operator=(const Server&) = delete;

    int port() const;
    /// "http://127.0.0.1:PORT/TOKEN/"
    std::string address() const;
    /// Serves until stop().
    void serve();
    /// Ends serve(), from any thread, and the session's searches.
    void stop();

private:
    struct Data;
    std::unique_ptr<Data> data_;
};

} // namespace view
} // namespace foam
