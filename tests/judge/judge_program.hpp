// The judge, run as a program.
#pragma once

#include "cli/program.hpp"
#include "support/shared_folder.hpp"

#include <fmt/format.h>

namespace foam::test {

class Judge : public Cli {
protected:
    /// `arguments` as in a shell.
    Outcome judge(const std::string& arguments) const { return shell("'" FOAM_TEST_JUDGE "' " + arguments); }

    void write_urdf(const std::string& name, const std::string& collisions) const {
        write(name, "<robot name=\"r\"><link name=\"part\">" + collisions + "</link></robot>");
    }
    static std::string collision(const std::string& geometry, const std::string& origin = "") {
        return "<collision>" + (origin.empty() ? "" : "<origin " + origin + "/>") + "<geometry>" + geometry +
               "</geometry></collision>";
    }
    static std::string ball(double radius, const std::string& center = "0 0 0") {
        return collision(fmt::format("<sphere radius=\"{:.17g}\"/>", radius), "xyz=\"" + center + "\"");
    }
};

} // namespace foam::test
