#include "promises.hpp"

#include <foam/base/error.hpp>
#include <foam/base/internal/files.hpp>
#include <foam/base/text.hpp>
#include <foam/sdk/kinds.hpp>

#include <cmath>

namespace foam::inline runtime {
namespace {

constexpr std::string_view no_models[] = {"", "words without a meaning\n", "\x7f\x01\x02 noise", "solid part\nendsolid part\n",
                                          "foam: 1\nname: recipe\nmesh: [part.stl]\n"};

void require_model(const SphereFile& model, const std::string& file) {
    require(!model.format.empty(), fmt::format("{}: it does not name the format", file));
    for (const LinkSpheres& link : model.links) {
        for (const Sphere& s : link.elements.spheres()) {
            require(is_finite(s.center) && std::isfinite(s.radius),
                    fmt::format("{}: it gives a sphere of link '{}' that is not finite", file, link.link));
        }
        for (const Element& element : link.elements.shaped()) {
            require(is_valid(element), fmt::format("{}: it gives {} of link '{}' that is no body", file,
                                                   with_article(noun_of(element.kind, 1)), link.link));
        }
    }
}

/// Requires that the reader reads the text, or refuses it by an Error(input) that names the file.
void require_model_or_refusal(const ModelReader& reader, const std::string& text, const std::string& file,
                              bool must_refuse) {
    QuietContext context;
    try {
        require_model(reader.read(text, file, context), file);
    } catch (const Error& error) {
        const std::string message = error.what();
        require(error.code() == ErrorCode::input,
                fmt::format("it refuses with the wrong code: {}; remedy: ErrorCode::input", message));
        require(message.find(file) != message.npos, fmt::format("its message does not name the file: {}", message));
        return;
    }
    require(!must_refuse, fmt::format("it takes '{}' for a sphere model", text));
}

bool equal(const SphereFile& a, const SphereFile& b) {
    return a.format == b.format && a.notes == b.notes &&
           std::equal(a.links.begin(), a.links.end(), b.links.begin(), b.links.end(),
                      [](const LinkSpheres& x, const LinkSpheres& y) {
                          return x.link == y.link && x.elements == y.elements;
                      });
}

/// Returns the text without a byte order mark and blanks before it; samples do not begin with comments.
std::string_view beginning(std::string_view text) {
    text.remove_prefix(text.starts_with("\xEF\xBB\xBF") ? 3 : 0);
    return text.substr(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
}

void check_sample(const ModelReader& reader, const std::string& text, const std::string& file) {
    QuietContext context;
    const SphereFile model = reader.read(text, file, context);
    require_model(model, file);
    require(!model.links.empty(), fmt::format("{}: it gives no link", file));
    require(equal(reader.read(text, file, context), model), "the second time it gives another model");
    for (const std::size_t share : {1, 3, 5, 7}) {
        require_model_or_refusal(reader, text.substr(0, text.size() * share / 8), file, false);
    }
}

} // namespace

void check_model_reader(const ModelReader& reader, const ContractOptions& options, Promises& promises) {
    promises.check("recognises nothing in other files", [&] {
        for (const std::string_view text : no_models) {
            require(!reader.recognises(text), fmt::format("it recognises '{}' as its format", text));
        }
    });
    promises.check("refuses what is no sphere model", [&] {
        for (const std::string_view text : no_models) {
            require_model_or_refusal(reader, std::string(text), "no.model", true);
        }
    });
    bool recognised = options.samples.empty();
    for (const std::filesystem::path& sample : options.samples) {
        const std::string text = read_file(sample);
        if (reader.recognises(beginning(text))) {
            recognised = true;
            promises.check(fmt::format("reads {}, whole, and cut off without a crash", sample.filename().string()),
                           [&] { check_sample(reader, text, sample.string()); });
        }
    }
    promises.check("recognises a sample", [&] { require(recognised, "it recognises none of the samples"); });
}

} // namespace foam::runtime
