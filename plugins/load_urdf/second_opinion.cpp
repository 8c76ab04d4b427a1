#include "reader.hpp"

#include <console_bridge/console.h>
#include <urdf_model/model.h>
#include <urdf_parser/urdf_parser.h>

#include <algorithm>
#include <mutex>

namespace foam::urdf {
namespace {

/// Catches the output of urdfdom. console_bridge has one handler for the whole process, so one parse at a time.
class Listener final : public console_bridge::OutputHandler {
public:
    Listener() : lock_(mutex()), level_(console_bridge::getLogLevel()) {
        console_bridge::useOutputHandler(this);
        console_bridge::setLogLevel(console_bridge::CONSOLE_BRIDGE_LOG_WARN);
    }
    ~Listener() override {
        console_bridge::setLogLevel(level_);
        console_bridge::restorePreviousOutputHandler();
    }
    Listener(const Listener&) = delete;
    Listener& operator=(const Listener&) = delete;

    void log(const std::string& text, console_bridge::LogLevel level, const char*, int) override {
        if (level >= console_bridge::CONSOLE_BRIDGE_LOG_ERROR) {
            errors.push_back(text);
        }
    }

    std::vector<std::string> errors;

private:
    static std::mutex& mutex() {
        static std::mutex instance;
        return instance;
    }
    std::lock_guard<std::mutex> lock_;
    console_bridge::LogLevel level_;
};

/// Returns the text with spaces in place of every <collision> and <visual> of a link.
std::string without_geometry(std::string_view text, const xml::Element& root) {
    std::string result(text);
    for (const xml::Element* link : root.children_named("link")) {
        for (const auto& child : link->children) {
            if (child->name == "collision" || child->name == "visual") {
                std::fill_n(result.begin() + static_cast<std::ptrdiff_t>(child->span.begin), child->span.size(), ' ');
            }
        }
    }
    return result;
}

} // namespace

std::vector<std::string> complaints_of_urdfdom(std::string_view text, const xml::Element& root) {
    Listener listener;
    try {
        if (!::urdf::parseURDF(without_geometry(text, root)) && listener.errors.empty()) {
            listener.errors.emplace_back("it gives no reason");
        }
    } catch (const std::exception& error) {
        listener.errors.emplace_back(error.what());
    }
    return listener.errors;
}

} // namespace foam::urdf
