#include "robots.hpp"

#include "meshes.hpp"

#include <numbers>

namespace foam::fuzz {
namespace {

std::string escaped(const std::string& text) {
    std::string result;
    for (const char c : text) {
        const auto code = static_cast<unsigned char>(c);
        if (c == '&' || c == '<' || c == '"' || code == 9 || code == 10 || code == 13) {
            result += "&#" + std::to_string(code) + ";";
        } else {
            result += c;
        }
    }
    return result;
}

/// Names that a URDF may hold, though nobody should give them.
std::string odd_name(Dice& dice) {
    static const std::vector<std::string> names{" ",
                                                "a b",
                                                "../../up",
                                                "/abs/olute",
                                                "a/b",
                                                "*",
                                                "[a-z]",
                                                "null",
                                                "1.5",
                                                "true",
                                                "\xE2\x80\xAEtfel",
                                                "\xC3\xA4\xC3\xB6",
                                                "tab\there",
                                                "new\nline",
                                                "quo\"te",
                                                "'",
                                                "a,b;c",
                                                "&amp;",
                                                "<link>",
                                                ".",
                                                "..",
                                                "~",
                                                "-rf",
                                                "#",
                                                "%s%n",
                                                "{}",
                                                "{0}",
                                                "C:\\x",
                                                "a: b",
                                                "\xF0\x9F\xA4\x96",
                                                std::string(300, 'x'),
                                                "NUL",
                                                "base",
                                                "__proto__",
                                                "world"};
    return dice.of(names);
}

double length(Dice& dice, bool odd) {
    return odd && dice.chance(0.4) ? dice.odd_magnitude() : dice.magnitude(0.01, 1);
}

class UrdfWriter {
public:
    UrdfWriter(Dice& dice, bool odd_numbers)
        : dice_(dice), odd_(dice.chance(0.2) && odd_numbers), odd_names_(dice.chance(0.15)) {}

    RandomRobot robot() {
        const int count = dice_.chance(0.5) ? 1 : dice_.between(2, 4);
        std::string text =
            "<?xml version=\"1.0\"?>\n<robot name=\"" + (odd_names_ ? escaped(odd_name(dice_)) : "r") + "\">\n";
        for (int k = 0; k < count; ++k) {
            text += link(name("link", k, robot_.links));
        }
        for (int k = 1; k < count; ++k) {
            text += joint(name("joint", k, joints_), static_cast<std::size_t>(k));
        }
        robot_.files["robot.urdf"] = text + "</robot>\n";
        return std::move(robot_);
    }

private:
    std::string name(const char* kind, int k, std::vector<std::string>& names) {
        std::string result = std::string(kind) + std::to_string(k);
        if (odd_names_ && dice_.chance(0.7)) {
            const std::string odd = odd_name(dice_);
            result = std::find(names.begin(), names.end(), odd) == names.end() ? odd : odd + std::to_string(k);
        }
        names.push_back(result);
        return result;
    }

    std::string link(const std::string& name) {
        std::string text = "  <link name=\"" + escaped(name) + "\">\n";
        if (dice_.chance(0.3)) {
            text += "    <visual>" + geometry() + "</visual>\n";
        }
        const int count = dice_.chance(0.6) ? 1 : dice_.between(0, 4);
        for (int k = 0; k < count; ++k) {
            text += "    <collision>" + origin() + geometry() + "</collision>\n";
        }
        return text + "  </link>\n";
    }

    std::string triple(double x, double y, double z) { return text_of(x) + " " + text_of(y) + " " + text_of(z); }

    std::string origin() {
        if (dice_.chance(0.4)) {
            return "";
        }
        const double far = odd_ && dice_.chance(0.3) ? dice_.odd_magnitude() : dice_.magnitude(0.01, 1);
        const auto angle = [&] {
            constexpr double pi = std::numbers::pi;
            return dice_.chance(0.4) ? dice_.of({0.0, pi / 2, pi, -pi / 2}) : dice_.uniform(-pi, pi);
        };
        std::string text = "<origin xyz=\"" + triple(far, dice_.uniform(-0.3, 0.3), dice_.sign() * far) + "\"";
        if (dice_.chance(0.6)) {
            text += " rpy=\"" + triple(angle(), angle(), odd_ && dice_.chance(0.1) ? dice_.odd_magnitude() : angle()) +
                    "\"";
        }
        return text + "/>";
    }

    std::string geometry() {
        std::string shape;
        switch (dice_.below(7)) {
        case 0:
            shape = "<box size=\"" + triple(length(dice_, odd_), length(dice_, odd_), length(dice_, odd_)) + "\"/>";
            break;
        case 1:
            shape = "<sphere radius=\"" + text_of(length(dice_, odd_)) + "\"/>";
            break;
        case 2:
            shape = "<cylinder radius=\"" + text_of(length(dice_, odd_)) + "\" length=\"" +
                    text_of(length(dice_, odd_)) + "\"/>";
            break;
        case 3:
            shape = "<capsule radius=\"" + text_of(length(dice_, odd_)) + "\" length=\"" +
                    text_of(dice_.chance(0.1) ? 0 : length(dice_, odd_)) + "\"/>";
            break;
        default:
            shape = mesh();
        }
        return "<geometry>" + shape + "</geometry>";
    }

    std::string mesh() {
        if (meshes_.empty() || dice_.chance(0.6)) {
            const std::string format = random_format(dice_);
            const std::string file = "m" + std::to_string(meshes_.size()) + "." + ending_of(format);
            robot_.files[file] = mesh_file(random_mesh(dice_, odd_ && dice_.chance(0.5)), format);
            meshes_.push_back(file);
        }
        std::string text = "<mesh filename=\"" + dice_.of(meshes_) + "\"";
        if (dice_.chance(0.4)) {
            const double size = odd_ && dice_.chance(0.3) ? dice_.odd_magnitude() : dice_.of({1.0, 0.001, 0.5, 2.0});
            const double other = dice_.chance(0.7) ? size : size * dice_.magnitude(0.1, 3);
            text +=
                " scale=\"" + triple(dice_.chance(0.3) ? -size : size, other, dice_.chance(0.1) ? -size : size) + "\"";
        }
        return text + "/>";
    }

    std::string joint(const std::string& name, std::size_t child) {
        const std::string type =
            dice_.of({"fixed", "fixed", "revolute", "continuous", "prismatic", "planar", "floating"});
        if (type != "fixed" && type != "planar" && type != "floating") {
            robot_.moving_joints.push_back(name);
        }
        std::string text = "  <joint name=\"" + escaped(name) + "\" type=\"" + type + "\">" + origin();
        text += "<parent link=\"" + escaped(robot_.links[dice_.below(child)]) + "\"/><child link=\"" +
                escaped(robot_.links[child]) + "\"/>";
        if (type != "fixed" && dice_.chance(0.7)) {
            text += "<axis xyz=\"" + triple(dice_.uniform(-1, 1), 1, odd_ ? dice_.odd_magnitude() : 0) + "\"/>";
        }
        if (type == "revolute" || type == "prismatic") {
            text += "<limit lower=\"" + text_of(dice_.uniform(-1, 0.5)) + "\" upper=\"" + text_of(dice_.uniform(0, 2)) +
                    "\" effort=\"1\" velocity=\"1\"/>";
        }
        return text + "</joint>\n";
    }

    Dice& dice_;
    bool odd_, odd_names_;
    RandomRobot robot_;
    std::vector<std::string> joints_, meshes_;
};

} // namespace

RandomRobot random_robot(Dice& dice, bool odd_numbers) {
    return UrdfWriter(dice, odd_numbers).robot();
}

} // namespace foam::fuzz
