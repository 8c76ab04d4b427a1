#include "object.hpp"

#include <foam/base/error.hpp>
#include <foam/base/text.hpp>
#include <foam/xml/document.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace foam::sdf {
namespace {

using xml::Element;

/// Reads links of models within models.
class Reader {
public:
    Reader(std::string_view text, const std::filesystem::path& file)
        : text_(text), result_{.file = file, .format = "SDF", .links = {}, .fixed_joints = {}, .notes = {}} {}

    SphereFile read() {
        const auto root = xml::parse(text_, result_.file.string(), ErrorCode::input);
        if (root->name != "sdf") {
            fail(*root, fmt::format("the root element is <{}>, not <sdf>", root->name));
        }
        std::size_t models = root->children_named("model").size();
        for (const Element* world : root->children_named("world")) {
            models += world->children_named("model").size();
        }
        read_models(*root, "", models > 1);
        for (const Element* world : root->children_named("world")) {
            read_models(*world, "", models > 1);
        }
        if (models == 0) {
            fail(*root, "there is no <model>");
        }
        return std::move(result_);
    }

private:
    [[noreturn]] void fail(const Element& at, const std::string& why) const {
        throw Error(ErrorCode::input, fmt::format("{}:{}: {}", result_.file.string(), at.line, shown(why)));
    }

    const std::string& name_of(const Element& element) const {
        const std::string* name = element.attribute("name");
        if (!name || name->empty()) {
            fail(element, fmt::format("<{}> has no name", element.name));
        }
        return *name;
    }

    /// Reads the models of an element; those within others, which are at most as deep as the parser allows.
    void read_models(const Element& holder, const std::string& scope, bool scoped) {
        for (const Element* model : holder.children_named("model")) {
            const std::string inner = scoped ? scope + name_of(*model) + "::" : scope;
            for (const Element* link : model->children_named("link")) {
                read_link(*link, inner);
            }
            read_models(*model, inner, true);
        }
    }

    void read_link(const Element& link, const std::string& scope) {
        const std::string& own_name = name_of(link);
        std::set<std::string> others;
        std::vector<Sphere> spheres;
        for (const Element* collision : link.children_named("collision")) {
            const Element* geometry = collision->child("geometry");
            const Element* sphere = geometry ? geometry->child("sphere") : nullptr;
            const Element* pose = collision->child("pose");
            if (!sphere) {
                others.insert(geometry && !geometry->children.empty() ? geometry->children.front()->name : "none");
                continue;
            }
            const std::string* frame = pose ? pose->attribute("relative_to") : nullptr;
            if (frame && !frame->empty() && *frame != own_name) {
                fail(*pose,
                     fmt::format("the sphere is placed in the frame '{}'; remedy: give its place in the frame of "
                                 "its link, without relative_to",
                                 *frame));
            }
            spheres.push_back({pose ? position(*pose) : Vec3{}, radius(*sphere)});
        }
        if (!others.empty()) {
            result_.notes.push_back(
                fmt::format("link '{}' has collision geometry other than spheres ({}), which is not judged",
                            scope + own_name, fmt::join(others, ", ")));
        }
        if (!spheres.empty()) {
            std::vector<Sphere>& target = spheres_of(result_, scope + own_name);
            target.insert(target.end(), spheres.begin(), spheres.end());
        }
    }

    std::vector<double> numbers(const Element& element) const {
        std::vector<double> result;
        const std::string_view content =
            element.self_closing() ? std::string_view()
                                   : text_.substr(element.start_tag.end, element.end_tag - element.start_tag.end);
        for (const std::string_view word : words(content)) {
            const std::optional<double> value = parse_number(word);
            if (!value) {
                fail(element, fmt::format("<{}>: '{}' is not a finite number", element.name, word));
            }
            result.push_back(*value);
        }
        return result;
    }

    Vec3 position(const Element& pose) const {
        const std::vector<double> values = numbers(pose);
        if (!values.empty() && values.size() != 6 && values.size() != 7) { // 7: with a quaternion
            fail(pose, fmt::format("<pose> has {} numbers; expected are 6", values.size()));
        }
        return values.empty() ? Vec3{} : Vec3{values[0], values[1], values[2]};
    }

    double radius(const Element& sphere) const {
        const Element* element = sphere.child("radius");
        const std::vector<double> values = element ? numbers(*element) : std::vector<double>{};
        if (values.size() != 1) {
            fail(element ? *element : sphere, "a sphere needs one <radius>");
        }
        return values.front();
    }

    std::string_view text_;
    SphereFile result_;
};

} // namespace

bool is_sdf(std::string_view text) {
    return xml::root_name(text) == "sdf";
}

SphereFile read_sdf(const std::string& text, const std::filesystem::path& file) {
    return Reader(text, file).read();
}

} // namespace foam::sdf
