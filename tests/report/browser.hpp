// A browser that shows the report of a run, where there is one.
#pragma once

#include "fixture.hpp"

#include <cstdlib>

namespace foam::test {

class InBrowser : public ReportOfRun {
protected:
    static constexpr const char* software_gl = "--use-gl=angle --use-angle=swiftshader --enable-unsafe-swiftshader";

    void SetUp() override {
        if (std::string(FOAM_TEST_CHROMIUM).empty()) {
            GTEST_SKIP() << "chromium is not installed";
        }
    }

    /// Opens out/report.html; what the browser prints goes to `output`. False if it does not start here.
    bool browse(const std::string& options, const std::string& output) const {
        const std::string dir = folder.path().string();
        const std::string command = "cd '" + dir + "' && HOME='" + dir +
                                    "' timeout 200 '" FOAM_TEST_CHROMIUM
                                    "' --headless --no-sandbox --disable-gpu --no-first-run --user-data-dir='" +
                                    dir + "/profile' --virtual-time-budget=20000 " + options + " 'file://" + dir +
                                    "/out/report.html' >'" + output + "' 2>browser.txt";
        return std::system(command.c_str()) == 0;
    }

    std::string why_not() const {
        return "the browser does not start here: " + read_file(folder.path() / "browser.txt");
    }

    /// Has the report run a script of ours at its end, which its policy would refuse.
    void let_in(const std::string& script) const {
        std::string html = read_file(folder.path() / "out/report.html");
        const std::size_t policy = html.find("<meta http-equiv=\"Content-Security-Policy\"");
        html.erase(policy, html.find('>', policy) + 1 - policy);
        html.replace(html.rfind("</body>"), 7, "<script>" + script + "</script></body>");
        write_file(folder.path() / "out/report.html", html);
    }
};

} // namespace foam::test
