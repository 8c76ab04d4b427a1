#include <foam/view/server.hpp>

#include "session_work.hpp"

#include <foam/base/error.hpp>
#include <foam/base/text.hpp>
#include <foam/view/scene.hpp>

#include <fmt/format.h>
#include <httplib.h>
#include <nlohmann/json.hpp>

#include <sys/random.h>

#include <algorithm>
#include <array>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>

namespace foam::inline view {

namespace {

/// Returns 32 hexadecimal digits from the random numbers of the operating system. Throws Error(internal) if it has
/// none.
std::string random_token() {
    std::array<unsigned char, 16> bytes{};
    if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size())) {
        throw Error(ErrorCode::internal, "the operating system gives no random numbers");
    }
    return fmt::format("{:02x}", fmt::join(bytes, ""));
}

/// Compares in a time that does not depend on where the texts differ.
bool same_secret(std::string_view a, std::string_view b) {
    unsigned difference = a.size() == b.size() ? 0 : 1;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
        difference |= static_cast<unsigned char>(a[i]) ^ static_cast<unsigned>(static_cast<unsigned char>(b[i]));
    }
    return difference == 0;
}

constexpr const char* loopback = "127.0.0.1";

/// What every answer says to browsers: nothing of it may be read, framed or kept by another page.
const httplib::Headers& common_headers() {
    static const httplib::Headers headers{
        {"Content-Security-Policy",
         "default-src 'none'; script-src 'self'; style-src 'self'; connect-src 'self'; img-src "
         "data:; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"},
        {"Cross-Origin-Opener-Policy", "same-origin"},
        {"Cross-Origin-Resource-Policy", "same-origin"},
        {"X-Content-Type-Options", "nosniff"},
        {"X-Frame-Options", "DENY"},
        {"Referrer-Policy", "no-referrer"},
        {"Cache-Control", "no-store"}};
    return headers;
}

void answer(httplib::Response& response, int status, const std::string& error) {
    response.status = status;
    response.set_content(
        nlohmann::json{{"error", error}}.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace),
        "application/json");
}

/// One thread for each connection: slow clients keep only their own waiting.
class Connections final : public httplib::TaskQueue {
public:
    void enqueue(std::function<void()> job) override {
        const std::lock_guard lock(mutex_);
        jobs_.push_back(std::move(job));
        if (idle_ < jobs_.size() && threads_.size() < most) {
            threads_.emplace_back([this] { work(); });
        }
        changed_.notify_one();
    }

    void shutdown() override {
        {
            const std::lock_guard lock(mutex_);
            ended_ = true;
        }
        changed_.notify_all();
        for (std::thread& thread : threads_) {
            thread.join();
        }
    }

private:
    static constexpr std::size_t most = 1000;

    void work() {
        std::unique_lock lock(mutex_);
        while (true) {
            ++idle_;
            changed_.wait(lock, [this] { return ended_ || !jobs_.empty(); });
            --idle_;
            if (jobs_.empty()) {
                return;
            }
            const std::function<void()> job = std::move(jobs_.front());
            jobs_.pop_front();
            lock.unlock();
            job();
            lock.lock();
        }
    }

    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<std::function<void()>> jobs_;
    std::vector<std::thread> threads_;
    std::size_t idle_ = 0;
    bool ended_ = false;
};

} // namespace

struct [[gnu::visibility("hidden")]] Server::Data {
    Session& session;
    Wording wording;
    httplib::Server http;
    std::string token = random_token();
    int port = 0;

    Data(Session & s, Wording w) : session(s), wording(std::move(w)) {}

    std::string message_of(const std::exception& error) const {
        return shown_lines(wording ? wording(error.what()) : error.what());
    }

    bool is_own_host(const std::string& host) const {
        return host == fmt::format("{}:{}", loopback, port) || host == fmt::format("localhost:{}", port);
    }

    /// Returns why a request is refused before it is read; 0: it is not.
    int refused(const httplib::Request& request) const {
        if (request.get_header_value_count("Host") != 1 || !is_own_host(request.get_header_value("Host"))) {
            return 421; // another name leads here (DNS rebinding)
        }
        const bool changes = request.method == "POST";
        if (!changes && request.method != "GET") {
            return 405;
        }
        const std::string origin = request.get_header_value("Origin");
        const bool own = origin.starts_with("http://") && is_own_host(origin.substr(7));
        const std::string site = request.get_header_value("Sec-Fetch-Site");
        if ((request.has_header("Origin") && !own) || (changes && !own) || site == "cross-site" ||
            site == "same-site") {
            return 403;
        }
        const std::size_t end = request.path.find('/', 1);
        if (request.path.empty() || request.path[0] != '/' || end == std::string::npos ||
            !same_secret(std::string_view(request.path).substr(1, end - 1), token)) {
            return 404;
        }
        if (changes && !request.get_header_value("Content-Type").starts_with("application/json")) {
            return 415;
        }
        // A chunked body has no length that could be checked before it is read.
        if (request.has_header("Transfer-Encoding") || request.has_header("Content-Encoding")) {
            return 411;
        }
        return 0;
    }

    void get(const std::string& name, std::function<PageFile()> file) {
        http.Get("/" + token + "/" + name, [file](const httplib::Request&, httplib::Response& response) {
            const PageFile content = file();
            response.set_content(content.content, content.type);
        });
    }

    void post(const std::string& name, std::string (*answered)(Session&, const std::string&)) {
        http.Post("/" + token + "/" + name,
                  [this, answered](const httplib::Request& request, httplib::Response& response) {
                      try {
                          response.set_content(answered(session, request.body), "application/json");
                      } catch (const Error& error) {
                          answer(response, error.code() == ErrorCode::internal ? 500 : 400, message_of(error));
                      }
                  });
    }

    void route() {
        http.set_pre_routing_handler([this](const httplib::Request& request, httplib::Response& response) {
            for (const auto& [name, value] : common_headers()) {
                response.set_header(name, value);
            }
            const int status = refused(request);
            if (status == 0) {
                return httplib::Server::HandlerResponse::Unhandled;
            }
            answer(response, status, "refused");
            response.set_header("Connection", "close"); // its body is not read
            return httplib::Server::HandlerResponse::Handled;
        });
        http.set_exception_handler(
            [this](const httplib::Request&, httplib::Response& response, std::exception_ptr thrown) {
                try {
                    std::rethrow_exception(thrown);
                } catch (const std::exception& error) {
                    answer(response, 500, message_of(error));
                }
            });
        for (const char* name : {"", "view.css", "view.js"}) {
            get(name, [name] { return served_file(name); });
        }
        get("scene", [this] { return PageFile{session_scene(session), "application/octet-stream"}; });
        get("meshes", [this] { return PageFile{fine_mesh_bytes(session.subject()), "application/octet-stream"}; });
        post("edit", answer_edit);
        post("undo", answer_undo);
        post("redo", answer_redo);
        post("save", answer_save);
        post("proofs", answer_proofs);
        post("ignored", answer_ignored);
        post("figures", answer_figures);
    }
};

Server::Server(Session& session, int port, Wording wording)
    : data_(std::make_unique<Data>(session, std::move(wording))) {
    httplib::Server& http = data_->http;
    http.new_task_queue = [] { return new Connections; };
    http.set_payload_max_length(most_body);
    http.set_read_timeout(5);
    http.set_write_timeout(30);
    http.set_keep_alive_max_count(1000);
    http.set_keep_alive_timeout(1); // a page that is open keeps the end waiting so long
    http.set_tcp_nodelay(true);
    // The library would share a port that another server has.
    http.set_socket_options([](socket_t socket) {
        const int yes = 1;
        setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    });
    if (port == 0) {
        data_->port = http.bind_to_any_port(loopback);
    } else if (http.bind_to_port(loopback, port)) {
        data_->port = port;
    }
    if (data_->port <= 0) {
        throw Error(ErrorCode::usage,
                    fmt::format("port {} of {} cannot be taken; remedy: another --port", port, loopback));
    }
    data_->route();
}

Server::~Server() = default;

int Server::port() const {
    return data_->port;
}

std::string Server::address() const {
    return fmt::format("http://{}:{}/{}/", loopback, data_->port, data_->token);
}

void Server::serve() {
    data_->http.listen_after_bind();
}

void Server::stop() {
    data_->session.stop();
    data_->http.stop();
}

} // namespace foam::inline view
