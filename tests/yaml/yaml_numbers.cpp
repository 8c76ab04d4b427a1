// Prints numbers and names as YAML, beside what they are: a list of [value, text of the value].
#include <foam/base/text.hpp>
#include <foam/yaml/write.hpp>

#include <cstdio>

int main() {
    using namespace foam;
    std::string text;
    for (const double value : {0.0, -0.0, 1.0, 1e-5, 1e5, 1e22, 1.5e-300, 0.1, 1.0 / 3, 123456789.0, 5e-324}) {
        text += "- [" + yaml::real_text(value) + ", \"" + number_text(value) + "\", number]\n";
    }
    for (const char* name :
         {"on", "yes", "no",   "null", "~",     "1",    "1e3",        "a: b", "#x", "panda_link0", "off",
          "y",  "N",   "1:30", "0o7",  "1_000", ".inf", "2001-01-01", "=",    "<<", "e3"}) {
        text += "- [" + yaml::scalar_text(name) + ", " + yaml::scalar_text(std::string("_") + name) + ", name]\n";
    }
    std::fputs(text.c_str(), stdout);
}
