#include "gltf.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace foam::load_mesh {
namespace {

/// Extensions that this plugin reads.
constexpr std::array read_extensions{"KHR_mesh_quantization", "EXT_mesh_gpu_instancing"};

/// Extensions for the look of the surface or its metadata, never its place.
constexpr std::array only_looks{"KHR_materials_",  "KHR_texture_", "EXT_texture_", "MSFT_texture_",
                                "KHR_techniques_", "KHR_lights_",  "EXT_lights_",  "KHR_xmp",
                                "ADOBE_materials", "MSFT_packing", "KHR_animation"};

/// Compressed forms of data that the file also has uncompressed, unless it requires them.
constexpr std::array compressions{"KHR_draco_mesh_compression", "EXT_meshopt_compression", "KHR_meshopt_compression"};

bool is_harmless(const std::string& name) {
    return std::find(read_extensions.begin(), read_extensions.end(), name) != read_extensions.end() ||
           std::any_of(only_looks.begin(), only_looks.end(),
                       [&](const char* begin) { return name.starts_with(begin); });
}

bool is_compression(const std::string& name) {
    return std::find(compressions.begin(), compressions.end(), name) != compressions.end();
}

} // namespace

void check_extensions(const Source& source, const JsonPlace& root, Context& context) {
    const auto required = root.find("extensionsRequired"), used = root.find("extensionsUsed");
    for (std::size_t i = 0; required && i < required->size(); ++i) {
        const std::string name = (*required)[i].text();
        if (!is_harmless(name)) {
            throw source.error(fmt::format("it needs the extension {}, which is not read; remedy: export without {}",
                                           printable(name), is_compression(name) ? "compression" : "it"));
        }
    }
    for (std::size_t i = 0; used && i < used->size(); ++i) {
        const std::string name = (*used)[i].text();
        if (!is_harmless(name) && !is_compression(name)) {
            context.log(Severity::warning,
                        fmt::format("{}: it uses the extension {}, which is not read; what that adds "
                                    "to the shape is left out",
                                    source.file.string(), printable(name)));
        }
    }
}

std::vector<Affine> instances(const JsonPlace& node, const Affine& pose, GltfAccessors& accessors) {
    const auto extensions = node.find("extensions");
    const auto instancing = extensions ? extensions->find("EXT_mesh_gpu_instancing") : std::nullopt;
    if (!instancing) {
        return {pose};
    }
    const JsonPlace attributes = instancing->at("attributes");
    const auto values = [&](const char* name, std::uint64_t width) {
        const auto index = attributes.find(name);
        return index ? accessors.vectors(*index, width) : std::vector<double>{};
    };
    const std::vector<double> t = values("TRANSLATION", 3), r = values("ROTATION", 4), s = values("SCALE", 3);
    const std::size_t count = std::max({t.size() / 3, r.size() / 4, s.size() / 3});
    for (const auto& [size, width] : {std::pair{t.size(), 3u}, std::pair{r.size(), 4u}, std::pair{s.size(), 3u}}) {
        if (size != 0 && size != count * width) {
            throw attributes.error("is to name accessors of the same count");
        }
    }
    std::vector<Affine> poses;
    for (std::size_t i = 0; i < count; ++i) {
        Affine own;
        if (!t.empty()) {
            own = Affine::translation({t[3 * i], t[3 * i + 1], t[3 * i + 2]});
        }
        if (!r.empty()) {
            const auto turned = Affine::rotation(r[4 * i], r[4 * i + 1], r[4 * i + 2], r[4 * i + 3]);
            if (!turned) {
                throw attributes.error(fmt::format("has no rotation for instance {} (counted from 0)", i));
            }
            own = own * *turned;
        }
        if (!s.empty()) {
            own = own * Affine::scaling({s[3 * i], s[3 * i + 1], s[3 * i + 2]});
        }
        poses.push_back(pose * own);
    }
    return poses;
}

} // namespace foam::load_mesh
