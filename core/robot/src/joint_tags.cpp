#include "joint_tags.hpp"

#include <foam/base/error.hpp>
#include <foam/base/text.hpp>

#include <expat.h>
#include <fmt/format.h>

#include <limits>

namespace foam::inline robot {
namespace {

/// Collects tags while expat reads the text. Exceptions must not pass through expat's C frames: the first error is kept
/// and thrown afterwards.
class Notes {
public:
    explicit Notes(const Robot& robot) : robot_(robot), parser_(XML_ParserCreate(nullptr)) {
        XML_SetUserData(parser_, this);
        XML_SetElementHandler(parser_, on_start, on_end);
    }
    ~Notes() { XML_ParserFree(parser_); }
    Notes(const Notes&) = delete;
    Notes& operator=(const Notes&) = delete;

    std::map<std::string, JointTags> take() {
        const std::string& text = robot_.source;
        const bool fits = text.size() <= static_cast<std::size_t>(std::numeric_limits<int>::max());
        const bool xml =
            fits && XML_Parse(parser_, text.data(), static_cast<int>(text.size()), 1) == XML_STATUS_OK && is_urdf_;
        if (!complaint_.empty()) {
            throw Error(ErrorCode::input, complaint_);
        }
        return xml ? std::move(tags_) : std::map<std::string, JointTags>{};
    }

private:
    static void on_start(void* self, const XML_Char* name, const XML_Char** attributes) {
        static_cast<Notes*>(self)->start(name, attributes);
    }
    static void on_end(void* self, const XML_Char*) { --static_cast<Notes*>(self)->depth_; }

    static std::optional<std::string> attribute(const XML_Char** attributes, std::string_view name) {
        for (; *attributes; attributes += 2) {
            if (attributes[0] == name) {
                return attributes[1];
            }
        }
        return {};
    }

    void start(std::string_view name, const XML_Char** attributes) {
        const int depth = depth_++;
        if (depth == 0) {
            is_urdf_ = name == "robot";
        } else if (depth == 1) {
            joint_ = name == "joint" ? attribute(attributes, "name") : std::nullopt;
            if (joint_) {
                tags_[*joint_].line = line();
            }
        } else if (depth == 2 && joint_ && name == "limit") {
            tags_[*joint_].limited = true;
        } else if (depth == 2 && joint_ && name == "mimic") {
            read_mimic(attributes);
        }
    }

    void read_mimic(const XML_Char** attributes) {
        Mimic mimic;
        if (const auto joint = attribute(attributes, "joint")) {
            mimic.joint = *joint;
        } else {
            complain("<mimic> does not say which joint it follows; remedy: <mimic joint=\"NAME\"/>");
        }
        mimic.multiplier = number(attributes, "multiplier", 1);
        mimic.offset = number(attributes, "offset", 0);
        tags_[*joint_].mimic = mimic;
    }

    double number(const XML_Char** attributes, const char* name, double otherwise) {
        const auto text = attribute(attributes, name);
        if (!text) {
            return otherwise;
        }
        const std::vector<std::string_view> pieces = words(*text);
        const std::optional<double> value = pieces.size() == 1 ? parse_number(pieces.front()) : std::nullopt;
        if (!value) {
            complain(fmt::format("<mimic {}>: '{}' is not a finite number", name, *text));
        }
        return value.value_or(otherwise);
    }

    int line() const { return static_cast<int>(XML_GetCurrentLineNumber(parser_)); }

    void complain(const std::string& what) {
        if (complaint_.empty()) {
            complaint_ = fmt::format("{}:{}: {}", robot_.file.string(), line(), what);
        }
    }

    const Robot& robot_;
    XML_Parser parser_;
    int depth_ = 0;
    bool is_urdf_ = false;
    std::optional<std::string> joint_;
    std::map<std::string, JointTags> tags_;
    std::string complaint_;
};

} // namespace

std::map<std::string, JointTags> read_joint_tags(const Robot& robot) {
    return robot.source.empty() ? std::map<std::string, JointTags>{} : Notes(robot).take();
}

} // namespace foam::robot
