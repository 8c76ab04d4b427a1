#include "messages.hpp"

#include <foam/base/error.hpp>

#include <nlohmann/json.hpp>

namespace foam::inline batch {
namespace {

using Json = nlohmann::ordered_json;

/// Takes the values of known keys while a line is read.
class Reader final : public nlohmann::json_sax<Json> {
public:
    explicit Reader(bool head_alone) : head_alone_(head_alone) {}

    bool null() override { return true; }
    bool boolean(bool) override { return true; }
    bool number_integer(number_integer_t number) override { return take(static_cast<double>(number)); }
    bool number_unsigned(number_unsigned_t number) override { return take(static_cast<double>(number)); }
    bool number_float(number_float_t number, const string_t&) override { return take(number); }
    bool binary(binary_t&) override { return true; }
    bool string(string_t& text) override {
        std::string* target = depth_ == 1 && key_ == "id"                    ? &result.id
                              : depth_ == 1 && key_ == "digest"              ? &result.digest
                              : in_error_ && depth_ == 2 && key_ == "code"   ? &result.code
                              : in_error_ && depth_ == 2 && key_ == "reason" ? &result.reason
                                                                             : nullptr;
        if (target) {
            *target = std::move(text);
        }
        return true;
    }
    bool key(string_t& name) override {
        key_ = std::move(name);
        if (depth_ == 1) {
            in_error_ = key_ == "error";
            result.failed = result.failed || in_error_;
            complete = complete || (key_ != "id" && key_ != "digest"); // the two stand in front
        }
        return !(head_alone_ && complete);
    }
    bool start_object(std::size_t) override { return ++depth_ > 0; }
    bool end_object() override { return depth_-- > 0; }
    bool start_array(std::size_t) override { return ++depth_ > 0; }
    bool end_array() override { return depth_-- > 0; }
    bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception&) override {
        complete = false;
        return false;
    }

    ResultSummary result;
    bool complete = false; ///< id and digest were read

private:
    bool take(double number) {
        if (depth_ == 1 && key_ == "cpu_seconds") {
            result.cpu_seconds = number;
        }
        return true;
    }

    bool head_alone_, in_error_ = false;
    int depth_ = 0;
    std::string key_;
};

ResultSummary read(std::string_view line, bool head_alone) {
    Reader reader(head_alone);
    Json::sax_parse(line.begin(), line.end(), &reader);
    if (!reader.complete || reader.result.id.empty()) {
        throw Error(ErrorCode::input, "a line of the results is none of foam batch");
    }
    return std::move(reader.result);
}

} // namespace

ResultHead head_of(std::string_view line) {
    return read(line, true);
}

ResultSummary summary_of(std::string_view line) {
    return read(line, false);
}

} // namespace foam::batch
