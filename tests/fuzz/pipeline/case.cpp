#include "case.hpp"

#include "meshes.hpp"
#include "recipes.hpp"
#include "robots.hpp"

#include <foam/base/text.hpp>

#include <fstream>
#include <stdexcept>

namespace foam::fuzz {

std::string text_of(double value) {
    return number_text(value);
}

std::string quoted(const std::string& text) {
    static const char* const digits = "0123456789abcdef";
    std::string result = "\"";
    for (const char c : text) {
        const auto code = static_cast<unsigned char>(c);
        if (c == '"' || c == '\\') {
            result += std::string("\\") + c;
        } else if (code < 0x20) {
            result += std::string("\\x") + digits[code / 16] + digits[code % 16];
        } else {
            result += c;
        }
    }
    return result + "\"";
}

Case make_case(std::uint64_t seed, const Registry& registry, const CaseOptions& options) {
    Dice dice(derive_seed(seed, "pipeline"));
    Case made;
    made.seed = seed;
    made.robot = dice.chance(0.35);
    RecipeInput input;
    input.robot = made.robot;
    input.elements = options.elements;
    if (made.robot) {
        RandomRobot robot = random_robot(dice, options.odd_numbers);
        made.files = std::move(robot.files);
        made.input = "robot.urdf";
        input.links = robot.links;
        input.moving_joints = robot.moving_joints;
    } else {
        const std::string format = random_format(dice);
        made.input = "mesh." + ending_of(format);
        made.files[made.input] = mesh_file(random_mesh(dice, dice.chance(0.3) && options.odd_numbers), format);
    }
    input.file = made.input;
    made.files["recipe.yaml"] = random_recipe(derive_seed(seed, "recipe"), registry, input);
    made.threads = dice.chance(0.8) ? 1 : 2;
    made.cached = dice.chance(0.2);
    dice.chance(0.03); // keeps the draws of the seeds on record
    made.again = dice.chance(0.1);
    return made;
}

void write_case(const Case& made, const std::filesystem::path& folder) {
    std::filesystem::create_directories(folder);
    for (const auto& [name, text] : made.files) {
        std::ofstream stream(folder / name, std::ios::binary);
        if (!(stream << text).flush()) {
            throw std::runtime_error((folder / name).string() + " cannot be written");
        }
    }
}

} // namespace foam::fuzz
