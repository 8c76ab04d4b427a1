// A run whose names try to break out of a page, and its report.
#pragma once

#include "support/runs.hpp"

#include <foam/base/internal/files.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cstring>
#include <string>
#include <vector>

namespace foam::test {

/// The bytes of a base64 text.
inline std::string from_base64(const std::string& text) {
    const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string bytes;
    unsigned group = 0, bits = 0;
    for (const char c : text) {
        if (c == '=') {
            break;
        }
        group = group << 6 | static_cast<unsigned>(digits.find(c));
        bits += 6;
        if (bits >= 8) {
            bits -= 8;
            bytes += static_cast<char>(group >> bits & 0xFFU);
        }
    }
    return bytes;
}

/// The values of a little-endian array in base64, on a little-endian machine.
template <class T> std::vector<T> values(const nlohmann::json& text) {
    const std::string bytes = from_base64(text.get<std::string>());
    std::vector<T> result(bytes.size() / sizeof(T));
    std::memcpy(result.data(), bytes.data(), result.size() * sizeof(T));
    return result;
}

/// What stands between two texts; empty if they do not occur.
inline std::string between(const std::string& text, const std::string& begin, const std::string& end) {
    const std::size_t from = text.find(begin);
    const std::size_t to = from == text.npos ? from : text.find(end, from + begin.size());
    return to == text.npos ? "" : text.substr(from + begin.size(), to - from - begin.size());
}

inline constexpr const char* hostile_link = "<script>document.title='broken'</script>";

class ReportOfRun : public RunTest {
protected:
    ReportOfRun() {
        write_file(folder.path() / "a<b>&.obj",
                   "v 0 0 0\nv 0.1 0 0\nv 0.1 0.2 0\nv 0 0.2 0\nv 0 0 0.3\nv 0.1 0 0.3\nv 0.1 0.2 0.3\nv 0 0.2 0.3\n"
                   "f 1 4 3 2\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n"); // no lid
        write_file(folder.path() / "arm.urdf", R"(<?xml version="1.0"?>
<robot name="arm &lt;/title&gt;">
  <link name="&lt;script&gt;document.title='broken'&lt;/script&gt;"><collision><geometry>
    <mesh filename="a&lt;b&gt;&amp;.obj"/></geometry></collision></link>
  <link name="tip"><collision><geometry><cylinder radius="0.05" length="0.3"/></geometry></collision></link>
  <joint name="j" type="fixed"><origin xyz="0.1 0 0.3"/>
    <parent link="&lt;script&gt;document.title='broken'&lt;/script&gt;"/><child link="tip"/></joint>
</robot>
)");
    }

    Recipe recipe(const std::string& rest, const std::string& input = "robot: {urdf: arm.urdf}") {
        return recipe_of("name: arm\n" + input + "\n" + rest);
    }

    /// The report of a run, which lies in the folder `out`.
    std::string report_of(const Recipe& wanted, const std::string& out = "out", std::size_t threads = 0) {
        RunOptions with = options(out);
        with.threads = threads;
        result = run(wanted, registry, with);
        return read_file(folder.path() / out / "report.html");
    }

    static nlohmann::json scene_of(const std::string& html) {
        return nlohmann::json::parse(between(html, "<script type=\"application/json\" id=\"scene\">", "</script>"));
    }

    RunResult result;
};

} // namespace foam::test
