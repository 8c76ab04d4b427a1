// Stages of one plugin, and what they say of texts.
#pragma once

#include "models.hpp"
#include "support/shared_folder.hpp"
#include "support/read_spheres.hpp"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace foam::test {

/// Names that formats confuse with syntax, or cannot hold.
inline const std::vector<std::string>& hostile_names() {
    static const std::vector<std::string> names{"",
                                                " a ",
                                                "a b",
                                                "a\nb",
                                                "a\tb",
                                                "a\x01b",
                                                "\x7f",
                                                "\xff",
                                                "\xc3\xa9",
                                                "0",
                                                "1e3",
                                                "yes",
                                                "null",
                                                "#x",
                                                "a: b",
                                                "'",
                                                "\"",
                                                "\\",
                                                "\\n",
                                                "a\\101",
                                                "-",
                                                ".",
                                                "*",
                                                "* a",
                                                "]]>",
                                                "--",
                                                "<&>",
                                                "@a@",
                                                "{link}",
                                                "a/b",
                                                "::",
                                                "a::b",
                                                "__a__",
                                                "world",
                                                "0\x01"
                                                "1",
                                                "a-b",
                                                "a_b",
                                                "foam_spheres"};
    return names;
}

inline std::string contents(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

/// A plugin's reader and writer of a format.
struct Format {
    std::string plugin, write, read;

    std::unique_ptr<ModelReader> reader() const {
        Registry registry;
        const PluginRecord& record = registry.load(std::string(FOAM_TEST_PLUGINS "/") + plugin + ".so");
        EXPECT_TRUE(record.loaded()) << record.rejection;
        return registry.make<ModelReader>(read);
    }

    std::string text(const SphereModel& model, const std::map<std::string, ParameterValue>& parameters = {}) const {
        QuietContext context;
        return writer(plugin, write, parameters)->write(model, context);
    }

    SphereFile file(const std::string& text) const {
        QuietContext context;
        return reader()->read(text, "FILE", context);
    }

    std::string message(const std::string& text) const {
        try {
            file(text);
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::input);
            return error.what();
        }
        return {};
    }

    /// Expects that every hostile name comes back or is refused with a remedy, alone and beside others.
    void expect_hostile_names(bool one_link) const {
        std::vector<SphereGroup> all;
        const auto writes = writer(plugin, write);
        for (const std::string& name : hostile_names()) {
            SCOPED_TRACE("'" + name + "'");
            const SphereModel model = model_of(nullptr, {group_of(name, {}, flat_tree(awkward_spheres()))});
            QuietContext context;
            try {
                EXPECT_EQ(read_spheres(*writes, writes->write(model, context)), spheres_of(model));
                all.push_back(model.groups.front());
            } catch (const Error& error) {
                EXPECT_EQ(error.code(), ErrorCode::output);
                EXPECT_NE(std::string(error.what()).find("remedy"), std::string::npos) << error.what();
            }
        }
        if (!one_link) {
            const SphereModel model = model_of(nullptr, all);
            EXPECT_GT(all.size(), 20U);
            QuietContext context;
            EXPECT_EQ(read_spheres(*writes, writes->write(model, context)), spheres_of(model));
        }
    }

    /// Expects that every beginning of a text is read, or refused with the file's name.
    void expect_truncations(const std::string& whole) const {
        const auto reads = reader();
        QuietContext context;
        for (std::size_t size = 0; size < whole.size(); ++size) {
            reads->recognises(whole.substr(0, size));
            try {
                reads->read(whole.substr(0, size), "FILE", context);
            } catch (const Error& error) {
                EXPECT_EQ(error.code(), ErrorCode::input);
                EXPECT_TRUE(std::string(error.what()).starts_with("FILE")) << error.what();
            }
        }
    }
};

/// A robot of two links, the second 1 m above the first and a quarter turn about x; spheres on both.
inline SphereModel turned_model() {
    auto robot = std::make_shared<Robot>(*chain_of({"base", "tool"}));
    robot->joints[0].origin = Pose::from_xyz_rpy({0, 0, 1}, {std::acos(0.0), 0, 0});
    SphereModel model = model_of(robot, {group_of("base", {}, flat_tree({{{0, 0, 0.1}, 0.5}})),
                                         group_of("tool", {}, flat_tree({{{0.1, 0.2, 0.3}, 0.25}}))});
    model.provenance = "foam 1; part.urdf -- proved";
    return model;
}

} // namespace foam::test
