#include "animation.hpp"

#include <foam/base/error.hpp>

#include <png.h>
#include <webp/encode.h>
#include <webp/mux.h>

#include <cstdint>
#include <memory>

namespace foam::cli {
namespace {

struct Pixels {
    int width = 0, height = 0;
    std::vector<std::uint8_t> rgba;
};

Pixels decoded(const std::string& png) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    Pixels pixels;
    bool read = png_image_begin_read_from_memory(&image, png.data(), png.size()) != 0;
    if (read) {
        image.format = PNG_FORMAT_RGBA;
        pixels = {static_cast<int>(image.width), static_cast<int>(image.height), {}};
        pixels.rgba.resize(PNG_IMAGE_SIZE(image));
        read = png_image_finish_read(&image, nullptr, pixels.rgba.data(), 0, nullptr) != 0;
    }
    png_image_free(&image);
    if (!read) {
        throw Error(ErrorCode::internal, std::string("a frame of the animation is no PNG: ") + image.message);
    }
    return pixels;
}

void require(bool done, const char* what) {
    if (!done) {
        throw Error(ErrorCode::internal, std::string("the animation could not be encoded: ") + what);
    }
}

/// A still picture as libwebp takes it.
class Picture {
public:
    explicit Picture(const Pixels& pixels) {
        require(WebPPictureInit(&picture_) != 0, "version of libwebp");
        picture_.use_argb = 1;
        picture_.width = pixels.width;
        picture_.height = pixels.height;
        require(WebPPictureImportRGBA(&picture_, pixels.rgba.data(), 4 * pixels.width) != 0, "memory");
    }
    ~Picture() { WebPPictureFree(&picture_); }
    Picture(const Picture&) = delete;
    Picture& operator=(const Picture&) = delete;

    WebPPicture* get() { return &picture_; }

private:
    WebPPicture picture_{};
};

using Encoder = std::unique_ptr<WebPAnimEncoder, decltype(&WebPAnimEncoderDelete)>;

Encoder encoder_for(const Pixels& first) {
    WebPAnimEncoderOptions options;
    require(WebPAnimEncoderOptionsInit(&options) != 0, "version of libwebp");
    options.anim_params.loop_count = 0; // for ever
    Encoder encoder(WebPAnimEncoderNew(first.width, first.height, &options), &WebPAnimEncoderDelete);
    require(encoder != nullptr, "memory");
    return encoder;
}

} // namespace

std::string animated_webp(const std::vector<std::string>& frames, std::chrono::milliseconds each) {
    constexpr float quality = 85; // of 100; edges stay sharp
    WebPConfig config;
    require(WebPConfigInit(&config) != 0, "version of libwebp");
    config.quality = quality;
    const Encoder encoder = encoder_for(decoded(frames.at(0)));
    int time = 0; // ms
    for (const std::string& frame : frames) {
        Picture picture(decoded(frame));
        require(WebPAnimEncoderAdd(encoder.get(), picture.get(), time, &config) != 0,
                WebPAnimEncoderGetError(encoder.get()));
        time += static_cast<int>(each.count());
    }
    require(WebPAnimEncoderAdd(encoder.get(), nullptr, time, nullptr) != 0, WebPAnimEncoderGetError(encoder.get()));
    WebPData data;
    WebPDataInit(&data);
    require(WebPAnimEncoderAssemble(encoder.get(), &data) != 0, WebPAnimEncoderGetError(encoder.get()));
    std::string bytes(reinterpret_cast<const char*>(data.bytes), data.size);
    WebPDataClear(&data);
    return bytes;
}

} // namespace foam::cli
