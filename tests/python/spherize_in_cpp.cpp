// What a C++ program gets for the same call: the bytes of the spheres, and the time.
//
// spherize_in_cpp MESH COUNT EFFORT REPEATS   MESH: numbers of vertices and triangles (uint64), then their rows
// (float64,
//                                             uint32). Writes the spheres to stdout, the least seconds to stderr.
#include <foam/search/spherize.hpp>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <string>

int main(int argc, char** argv) {
    if (argc != 5) {
        return 2;
    }
    std::ifstream file(argv[1], std::ios::binary);
    std::uint64_t counts[2] = {};
    file.read(reinterpret_cast<char*>(counts), sizeof counts);
    foam::Mesh mesh;
    mesh.vertices.resize(counts[0]);
    mesh.triangles.resize(counts[1]);
    file.read(reinterpret_cast<char*>(mesh.vertices.data()),
              static_cast<std::streamsize>(counts[0] * sizeof(foam::Vec3)));
    file.read(reinterpret_cast<char*>(mesh.triangles.data()),
              static_cast<std::streamsize>(counts[1] * sizeof(foam::Triangle)));
    const std::string effort = argv[3];
    foam::CoverOptions options;
    options.effort = effort == "fast"   ? foam::Effort::fast
                     : effort == "best" ? foam::Effort::best
                                        : foam::Effort::normal;
    double least = 1e9;
    foam::SphereCover cover;
    for (int i = 0; i < std::stoi(argv[4]); ++i) {
        const auto start = std::chrono::steady_clock::now();
        cover = foam::spherize(mesh, std::stoul(argv[2]), options);
        least = std::min(least, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    }
    std::fwrite(cover.spheres.data(), sizeof(foam::Sphere), cover.spheres.size(), stdout);
    std::fprintf(stderr, "%.9f\n", least);
    return file ? 0 : 1;
}
