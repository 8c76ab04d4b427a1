#include <foam/runtime/internal/output.hpp>

#include <foam/base/internal/files.hpp>
#include <foam/base/text.hpp>
#include <foam/sdk/elements.hpp>
#include <foam/sdk/kinds.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace foam::inline runtime {

std::optional<TextFile> into_of(const Workspace& workspace, const OutputCall& output) {
    if (output.into.empty()) {
        return {};
    }
    const std::filesystem::path file =
        std::filesystem::absolute(workspace.recipe.file.parent_path() / output.into).lexically_normal();
    return TextFile{file, read_file(file, most_robot_bytes)};
}

/// The bytes of a file, and those of the writer without a folder.
struct WrittenText {
    std::string text, portable;
};

/// The files of an output.
struct WrittenTexts {
    std::vector<WrittenText> texts; ///< that of its writer, then the companions of that, in the order of the endings
    std::map<std::string, std::string> beside; ///< Writer::files_beside()
};

/// Returns the files of an output.
static WrittenTexts texts_of(const Writer& writer, const std::vector<std::string>& companions, SphereModel model,
                             const std::filesystem::path& target, Context& context) {
    const auto all = [&](Context& for_this) {
        std::vector<std::string> texts{writer.write(model, for_this)};
        if (model.into) {
            texts.front() = with_provenance(std::move(texts.front()), model);
        }
        for (const std::string& ending : companions) {
            texts.push_back(writer.companion(ending, model, for_this));
        }
        return texts;
    };
    QuietContext quiet;
    model.file = target.filename().string();
    std::vector<std::string> portable = all(quiet);
    model.folder = target.parent_path();
    std::vector<std::string> texts = all(context);
    WrittenTexts result;
    for (std::size_t i = 0; i < texts.size(); ++i) {
        result.texts.push_back({std::move(texts[i]), std::move(portable[i])});
    }
    result.beside = writer.files_beside(model, context);
    return result;
}

/// Returns the path in the run directory of a file beside an output. Throws Error(plugin) if it leads elsewhere, or is
/// another output.
static std::filesystem::path beside_file(const std::string& name, const OutputCall& output, const Recipe& recipe) {
    const std::filesystem::path relative(name);
    const std::filesystem::path file = (std::filesystem::path(output.file).parent_path() / relative).lexically_normal();
    const bool within = is_within_folder(relative);
    const bool taken = std::any_of(recipe.outputs.begin(), recipe.outputs.end(),
                                   [&](const OutputCall& other) { return other.file == file; });
    if (!within || taken) {
        throw Error(ErrorCode::plugin,
                    fmt::format("the writer broke its contract: it writes '{}' beside {}, {}", shown(name), output.file,
                                taken ? "which is another output" : "outside its folder"));
    }
    return file;
}

/// Writes a file into the run directory. Returns its record.
static OutputFile record_of(const WrittenText& written, const OutputCall& output, const std::string& file,
                            const RunDirectory& directory) {
    directory.write(file, written.text);
    return {.stage = output.writer.stage,
            .file = file,
            .digest = digest_of(written.text),
            .bytes = written.text.size(),
            .proofs = {},
            .portable_digest = written.portable == written.text ? Digest{} : digest_of(written.portable)};
}

std::vector<OutputFile> write_outputs(const Workspace& workspace, const FinishedModel& finished,
                                      const RunDirectory& directory) {
    const std::vector<OutputCall>& outputs = workspace.recipe.outputs;
    std::vector<WrittenTexts> texts(outputs.size());
    std::vector<std::unique_ptr<Writer>> writers(outputs.size());
    const auto as_task = [&](std::size_t i, const auto& body) {
        StageReport report;
        return run_stage(workspace, outputs[i].writer.stage, "", outputs[i].file, outputs[i].file, report, body);
    };
    workspace.journal.begin("writing");
    workspace.journal.expect(outputs.size());
    const auto companions = [&](std::size_t i) -> const std::vector<std::string>& {
        return workspace.registry.find(outputs[i].writer.stage)->info.companions;
    };
    parallel_for(outputs.size(), [&](std::size_t i) {
        texts[i] = as_task(i, [&](Context& context) {
            writers[i] = workspace.registry.make<Writer>(outputs[i].writer.stage, outputs[i].writer.given);
            require_held(workspace.registry.find(outputs[i].writer.stage)->info, finished.model);
            SphereModel model = finished.model;
            model.into = into_of(workspace, outputs[i]);
            return texts_of(*writers[i], companions(i), std::move(model), directory.target() / outputs[i].file,
                            context);
        });
    });
    workspace.journal.begin("proof");
    workspace.journal.expect(outputs.size());
    std::vector<std::vector<OutputFile>> files(outputs.size());
    parallel_for(outputs.size(), [&](std::size_t i) {
        std::vector<WrittenProof> proofs = as_task(i, [&](Context&) {
            return prove_written(writers[i]->read(texts[i].texts.front().text, texts[i].beside), finished,
                                 workspace.recipe.guarantee, workspace.recipe.proved_numbers(workspace.registry),
                                 outputs[i].file,
                                 workspace.registry.find(outputs[i].writer.stage)->info.consumer.elements_optional);
        });
        files[i].push_back(record_of(texts[i].texts.front(), outputs[i], outputs[i].file, directory));
        files[i].front().proofs = std::move(proofs);
        for (std::size_t k = 1; k < texts[i].texts.size(); ++k) {
            const std::string file = companion_of(outputs[i].file, companions(i)[k - 1]).string();
            files[i].push_back(record_of(texts[i].texts[k], outputs[i], file, directory));
        }
        for (const auto& [name, text] : texts[i].beside) {
            const std::string file = beside_file(name, outputs[i], workspace.recipe).string();
            files[i].push_back(record_of({text, text}, outputs[i], file, directory));
        }
    });
    std::vector<OutputFile> all;
    for (std::vector<OutputFile>& of_output : files) {
        std::move(of_output.begin(), of_output.end(), std::back_inserter(all));
    }
    return all;
}

} // namespace foam::inline runtime
