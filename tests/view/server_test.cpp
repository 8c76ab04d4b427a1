// The server: who may ask, what it refuses, and what it answers.
#include "arm.hpp"

#include <foam/view/server.hpp>

#include <httplib.h>
#include <nlohmann/json.hpp>

#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include <thread>

namespace foam::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

class ServerTest : public ArmTest {
protected:
    ServerTest() {
        const SubjectOptions options = with({"arm.urdf", "arm.csv"});
        session.emplace(subject(options), options, registry, folder.path());
        server.emplace(*session, 0, [](const std::string& text) { return "in other words, " + text; });
        thread = std::thread([this] { server->serve(); });
        const std::string address = server->address();
        base = address.substr(address.find('/', 8));
        origin = address.substr(0, address.find('/', 8));
        while (!client().Get(base)) {
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
    }
    ~ServerTest() override {
        server->stop();
        thread.join();
    }

    httplib::Client client() const { return httplib::Client("127.0.0.1", server->port()); }
    int get(const std::string& path, const httplib::Headers& headers = {}) const {
        auto answer = client().Get(path, headers);
        return answer ? answer->status : -1;
    }
    httplib::Result post(const std::string& name, const std::string& body, httplib::Headers headers) const {
        return client().Post(base + name, headers, body, "application/json");
    }
    httplib::Result post(const std::string& name, const std::string& body) const {
        return post(name, body, {{"Origin", origin}});
    }
    /// What the server answers to these bytes.
    std::string raw(const std::string& request) const {
        const int stream = socket(AF_INET, SOCK_STREAM, 0);
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_port = htons(static_cast<std::uint16_t>(server->port()));
        inet_pton(AF_INET, "127.0.0.1", &address.sin_addr);
        EXPECT_EQ(connect(stream, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
        EXPECT_EQ(send(stream, request.data(), request.size(), MSG_NOSIGNAL), static_cast<ssize_t>(request.size()));
        std::string answer;
        char bytes[4096];
        for (ssize_t n = 0; (n = recv(stream, bytes, sizeof bytes, 0)) > 0;) {
            answer.append(bytes, static_cast<std::size_t>(n));
        }
        close(stream);
        return answer;
    }
    std::string host() const { return origin.substr(7); }

    std::optional<Session> session;
    std::optional<Server> server;
    std::thread thread;
    std::string base, origin; ///< "/TOKEN/", "http://127.0.0.1:PORT"
};

/// Clients that send half a request keep only themselves waiting.
TEST_F(ServerTest, SlowClientsBlockNobody) {
    std::vector<int> slow;
    for (int i = 0; i < 16; ++i) {
        slow.push_back(socket(AF_INET, SOCK_STREAM, 0));
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_port = htons(static_cast<std::uint16_t>(server->port()));
        inet_pton(AF_INET, "127.0.0.1", &address.sin_addr);
        ASSERT_EQ(connect(slow.back(), reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
        ASSERT_EQ(send(slow.back(), "GET / HT", 8, MSG_NOSIGNAL), 8);
    }
    auto quick = client();
    quick.set_read_timeout(3); // less than the server waits for a slow client
    EXPECT_TRUE(quick.Get(base));
    for (const int stream : slow) {
        close(stream);
    }
}

TEST_F(ServerTest, ServesThePageToWhoKnowsTheAddress) {
    auto page = client().Get(base);
    ASSERT_TRUE(page);
    EXPECT_EQ(page->status, 200);
    EXPECT_THAT(page->body, HasSubstr("<script type=\"module\" src=\"view.js\">"));
    const std::string policy = page->get_header_value("Content-Security-Policy");
    EXPECT_THAT(policy,
                AllOf(HasSubstr("default-src 'none'"), HasSubstr("script-src 'self'"), HasSubstr("style-src 'self'"),
                      HasSubstr("frame-ancestors 'none'"), Not(HasSubstr("unsafe"))));
    EXPECT_EQ(page->get_header_value("Cache-Control"), "no-store");
    EXPECT_EQ(get(base + "view.js"), 200);
    EXPECT_EQ(get(base + "view.css"), 200);
    auto scene = client().Get(base + "scene");
    EXPECT_EQ(scene->body.substr(0, 8), "foamview");
    EXPECT_THAT(client().Get(base + "meshes")->body, AllOf(StartsWith("foamview"), HasSubstr("\"meshes\":[null")));
    EXPECT_EQ(base.size(), 34u); // 32 digits
}

TEST_F(ServerTest, RefusesWithoutTheToken) {
    for (const std::string& path :
         {std::string("/"), std::string("/view.js"), std::string("/scene"), "/" + std::string(32, '0') + "/",
          base.substr(0, base.size() - 2) + "/", base + "x", base + "../view.js", std::string("/..") + base,
          base + "%2e%2e/arm.urdf", base + "arm.urdf"}) {
        EXPECT_EQ(get(path), 404) << path;
    }
}

TEST_F(ServerTest, TwoServersHaveOtherTokens) {
    Server other(*session);
    EXPECT_NE(other.address().substr(other.address().find('/', 8)), base);
    EXPECT_THAT(refusal([&] { Server(*session, server->port()); }), HasSubstr("cannot be taken"));
}

TEST_F(ServerTest, TellsErrorsInTheGivenWords) {
    EXPECT_THAT(post("save", R"({"version":0,"file":"x.unknown"})")->body, HasSubstr(R"({"error":"in other words, )"));
}

TEST_F(ServerTest, RefusesOtherHostsAndOrigins) {
    EXPECT_EQ(get(base, {{"Host", "evil.example"}}), 421);
    EXPECT_EQ(get(base, {{"Host", "127.0.0.1"}}), 421);
    EXPECT_EQ(get(base, {{"Host", "127.0.0.1.evil.example:" + std::to_string(server->port())}}), 421);
    EXPECT_EQ(get(base, {{"Host", "localhost:" + std::to_string(server->port())}}), 200);
    EXPECT_EQ(get(base, {{"Origin", "https://evil.example"}}), 403);
    EXPECT_EQ(get(base, {{"Origin", "null"}}), 403);
    EXPECT_EQ(get(base, {{"Sec-Fetch-Site", "cross-site"}}), 403);
    EXPECT_EQ(post("undo", R"({"version":0})", {})->status, 403); // a change names its origin
    EXPECT_EQ(post("undo", R"({"version":0})", {{"Origin", "http://evil.example"}})->status, 403);
    EXPECT_EQ(post("undo", R"({"version":0})", {{"Origin", origin + "0"}})->status, 403);
    EXPECT_THAT(
        raw("GET " + base + " HTTP/1.1\r\nHost: " + host() + "\r\nHost: evil.example\r\nConnection: close\r\n\r\n"),
        HasSubstr(" 421 "));
    EXPECT_THAT(raw("GET " + base + " HTTP/1.0\r\n\r\n"), HasSubstr(" 421 ")); // without a host
}

TEST_F(ServerTest, RefusesOtherMethodsTypesAndLengths) {
    EXPECT_EQ(client().Delete(base + "edit", {{"Origin", origin}})->status, 405);
    EXPECT_EQ(client().Put(base + "edit", {{"Origin", origin}}, "{}", "application/json")->status, 405);
    EXPECT_EQ(client().Options(base + "edit", {{"Origin", origin}})->status, 405); // no other origin is let in
    EXPECT_EQ(client().Post(base + "undo", {{"Origin", origin}}, "{}", "text/plain")->status, 415);
    EXPECT_EQ(post("edit", std::string(Server::most_body + 1, ' '))->status, 413);
    const std::string head = "POST " + base + "undo HTTP/1.1\r\nHost: " + host() + "\r\nOrigin: " + origin +
                             "\r\nContent-Type: application/json\r\n";
    EXPECT_THAT(raw(head + "Connection: close\r\nTransfer-Encoding: chunked\r\n\r\n2\r\n{}\r\n0\r\n\r\n"),
                HasSubstr(" 411 "));
    EXPECT_EQ(get(base), 200); // it lives on
}

TEST_F(ServerTest, RefusesBadBodiesAndChangesNothing) {
    for (const char* body : {"", "x", "[]", "{}", R"({"version":0})", R"({"version":0,"kind":"explode","model":0})",
                             R"({"version":0,"kind":"move","model":0,"link":0,"index":0})",
                             R"({"version":0,"kind":"move","model":0,"link":0,"index":0,"sphere":[1,2,3]})",
                             R"({"version":0,"kind":"move","model":0,"link":0,"index":0,"sphere":["1",2,3,4]})",
                             R"({"version":0,"kind":"move","model":0,"link":0,"index":0,"sphere":[1e999,2,3,4]})",
                             R"({"version":0,"kind":"move","model":-1,"link":0,"index":0,"sphere":[0,0,0,1]})",
                             R"({"version":0,"kind":"move","model":0,"link":1.5,"index":0,"sphere":[0,0,0,1]})",
                             R"({"version":9,"kind":"remove","model":0,"link":0,"index":0})",
                             R"({"version":0,"kind":"remove","model":0,"link":99999999999,"index":0})"}) {
        auto answer = post("edit", body);
        EXPECT_EQ(answer->status, 400) << body;
        EXPECT_FALSE(nlohmann::json::parse(answer->body)["error"].get<std::string>().empty()) << body;
    }
    EXPECT_EQ(post("edit", "{\"version\":0,\"kind\":\"" + std::string(30000, '[') + "\"}")->status, 400);
    EXPECT_EQ(post("edit", std::string(60000, '['))->status, 400); // deep nesting
    EXPECT_EQ(session->version(), 0u);
    EXPECT_EQ(post("save", R"({"model":0,"format":"urdf","file":"../x.urdf","replace":true})")->status, 400);
    EXPECT_EQ(post("proofs", R"({"model":7})")->status, 400);
}

TEST_F(ServerTest, EditsProvesAndSaves) {
    auto edit = post("edit", R"({"version":0,"kind":"move","model":0,"link":1,"index":0,"sphere":[0,0,0.2,0.1]})");
    ASSERT_EQ(edit->status, 200) << edit->body;
    const auto changed = nlohmann::json::parse(edit->body);
    EXPECT_EQ(changed["version"], 1);
    EXPECT_EQ(changed["undo"], true);
    EXPECT_EQ(changed["links"]["1"]["spheres"][0], (std::vector<double>{0, 0, 0.2, 0.1}));
    EXPECT_EQ(changed["links"]["1"]["verdict"]["holds"], false);
    const auto proofs = nlohmann::json::parse(post("proofs", R"({"model":0})")->body);
    EXPECT_EQ(proofs["verdicts"][0]["holds"], true);
    EXPECT_EQ(proofs["verdicts"][1]["holds"], false);
    EXPECT_EQ(nlohmann::json::parse(post("ignored", R"({"model":0})")->body)["ignored"][0], (std::vector<int>{0, 1}));
    EXPECT_EQ(nlohmann::json::parse(post("figures", R"({"model":0})")->body)["protrusions"].size(), 4u);
    EXPECT_EQ(post("undo", R"({"version":1})")->status, 200);
    auto saved = post("save", R"({"model":0,"format":"csv","file":"saved.csv","replace":false})");
    ASSERT_EQ(saved->status, 200) << saved->body;
    EXPECT_THAT(text_of("saved.csv"), HasSubstr("upper,0,0,0.2,0.20801"));
}

TEST_F(ServerTest, AReloadShowsWhatWasEdited) {
    post("edit", R"({"version":0,"kind":"remove","model":0,"link":1,"index":0})");
    const std::string scene = client().Get(base + "scene")->body;
    EXPECT_THAT(scene, AllOf(HasSubstr("\"count\":3"), HasSubstr("\"version\":1")));
}

TEST_F(ServerTest, ManyAtOnceAreServedOneAfterTheOther) {
    std::vector<std::thread> threads;
    std::atomic<int> taken = 0, refused = 0;
    for (int i = 0; i < 8; ++i) {
        threads.emplace_back([&] {
            auto answer = post("edit", R"({"version":0,"kind":"add","model":0,"link":0,"sphere":[0,0,0,0.1]})");
            (answer->status == 200 ? taken : refused) += 1;
        });
    }
    for (std::thread& one : threads) {
        one.join();
    }
    EXPECT_EQ(taken, 1); // the others are of a version that is no more
    EXPECT_EQ(refused, 7);
    EXPECT_EQ(session->state(0)[0]->spheres.size(), 2u);
}

} // namespace
} // namespace foam::test
