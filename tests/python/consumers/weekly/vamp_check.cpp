// Asks VAMP's own collision code about poses:  vamp_check QUERIES SCENE... >ANSWERS
//
// A query is the joints and an obstacle of its own (x y z r), in single precision. An answer is a byte: bit 0: the robot
// touches itself or the obstacle of the query; bit 1: itself alone; bit 2 and up: itself or the scenes. Behind all answers
// are the centres of the spheres, by query. Standard error has the nanoseconds of a check among free poses in each scene.
#include <ctime>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

#include HEADER
#include <vamp/collision/factory.hh>

namespace {
constexpr auto rake = vamp::FloatVectorWidth;
using Scene = vamp::collision::Environment<float>;
using Lanes = vamp::collision::Environment<vamp::FloatVector<rake>>;
using Block = ROBOT::ConfigurationBlock<rake>;
namespace make = vamp::collision::factory;

Scene read_scene(const std::string &file) {
    Scene scene;
    std::ifstream in(file);
    std::string word;
    std::array<float, 3> a, b, c;
    float radius = 0;
    while (in >> word >> a[0] >> a[1] >> a[2]) {
        if (word == "box" && in >> b[0] >> b[1] >> b[2] >> c[0] >> c[1] >> c[2])
            scene.cuboids.push_back(make::cuboid::array(a, b, c));
        else if (word == "capsule" && in >> b[0] >> b[1] >> b[2] >> radius)
            scene.capsules.push_back(make::capsule::endpoints::array(a, b, radius));
        else if (word == "sphere" && in >> radius)
            scene.spheres.push_back(make::sphere::array(a, radius));
        else
            throw std::runtime_error("not a scene: " + file);
    }
    scene.sort();
    return scene;
}

Block block_of(const float *joints) {
    Block block;
    for (std::size_t j = 0; j < ROBOT::dimension; ++j) block[j] = vamp::FloatVector<rake, 1>(joints[j]);
    return block;
}

double nanoseconds(const Lanes &scene, const std::vector<Block> &free) {
    long valid = 0;
    const std::clock_t begin = std::clock();  // of the processor: others may run beside
    while (std::clock() - begin < CLOCKS_PER_SEC / 2 && !free.empty())
        for (const Block &block : free) valid += ROBOT::fkcc<rake>(scene, block);
    return valid > 0 ? 1e9 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC / static_cast<double>(valid) : 0;
}
}  // namespace

int main(int argc, char **argv) {
    constexpr std::size_t size = ROBOT::dimension + 4;
    std::ifstream in(argv[1], std::ios::binary);
    std::vector<float> query(size), centres;
    std::vector<Lanes> scenes{Lanes(Scene{})};
    for (int i = 2; i < argc; ++i) scenes.emplace_back(read_scene(argv[i]));
    std::vector<std::vector<Block>> free(scenes.size());
    while (in.read(reinterpret_cast<char *>(query.data()), size * sizeof(float))) {
        const Block block = block_of(query.data());
        Scene own;
        own.spheres.push_back(make::sphere::array({query[size - 4], query[size - 3], query[size - 2]}, query[size - 1]));
        unsigned char answer = ROBOT::fkcc<rake>(Lanes(own), block) ? 0 : 1;
        for (std::size_t s = 0; s < scenes.size(); ++s) {
            const bool valid = ROBOT::fkcc<rake>(scenes[s], block);
            if (!valid) answer |= static_cast<unsigned char>(2u << s);
            if (valid) free[s].push_back(block);
        }
        std::cout.put(static_cast<char>(answer));
        ROBOT::Spheres<rake> spheres;
        ROBOT::sphere_fk<rake>(block, spheres);
        for (std::size_t i = 0; i < ROBOT::n_spheres; ++i)
            for (const auto *axis : {&spheres.x, &spheres.y, &spheres.z}) centres.push_back((*axis)[{i, 0}]);
    }
    std::cout.write(reinterpret_cast<const char *>(centres.data()), static_cast<std::streamsize>(centres.size() * sizeof(float)));
    for (std::size_t s = 1; s < scenes.size(); ++s) std::cerr << nanoseconds(scenes[s], free[s]) << '\n';
}
