#include "colour_bar.hpp"

#include <opencv2/imgproc.hpp>

#include <ft2build.h>
#include FT_FREETYPE_H

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace foam::snapshot {
namespace {

/// Returns the code points of UTF-8 text; invalid bytes become U+FFFD.
std::vector<std::uint32_t> decode(const std::string& text) {
    std::vector<std::uint32_t> points;
    for (std::size_t i = 0; i < text.size();) {
        const auto lead = static_cast<unsigned char>(text[i++]);
        const int following = lead < 0x80 ? 0 : lead >> 5 == 6 ? 1 : lead >> 4 == 14 ? 2 : lead >> 3 == 30 ? 3 : -1;
        std::uint32_t point = following <= 0 ? lead : lead & (0x3Fu >> following);
        bool good = following >= 0;
        for (int k = 0; good && k < following; ++k) {
            good = i < text.size() && (static_cast<unsigned char>(text[i]) >> 6) == 2;
            if (good) {
                point = point << 6 | (static_cast<unsigned char>(text[i++]) & 0x3Fu);
            }
        }
        points.push_back(good ? point : 0xFFFD);
    }
    return points;
}

class TrueType final : public Lettering {
public:
    explicit TrueType(const std::string& file) {
        if (FT_Init_FreeType(&library_) == 0 && FT_New_Face(library_, file.c_str(), 0, &face_) != 0) {
            face_ = nullptr;
        }
    }
    ~TrueType() override {
        if (face_ != nullptr) {
            FT_Done_Face(face_);
        }
        if (library_ != nullptr) {
            FT_Done_FreeType(library_);
        }
    }
    TrueType(const TrueType&) = delete;
    TrueType& operator=(const TrueType&) = delete;

    bool readable() const { return face_ != nullptr; }

    double width(const std::string& text, double size) override {
        double pen = 0;
        set_size(size);
        for (const std::uint32_t point : decode(text)) {
            if (FT_Load_Char(face_, point, FT_LOAD_NO_HINTING) == 0) {
                pen += static_cast<double>(face_->glyph->advance.x) / 64;
            }
        }
        return pen;
    }

    void draw(cv::Mat3b& picture, const std::string& text, double x, double y, double size, cv::Vec3b colour) override {
        set_size(size);
        for (const std::uint32_t point : decode(text)) {
            // Glyphs are placed to a 64th of a pixel, unhinted, for even spacing at every size.
            const double whole = std::floor(x);
            FT_Vector shift{std::lround((x - whole) * 64), 0};
            FT_Set_Transform(face_, nullptr, &shift);
            if (FT_Load_Char(face_, point, FT_LOAD_RENDER | FT_LOAD_NO_HINTING) != 0) {
                continue;
            }
            const FT_GlyphSlot glyph = face_->glyph;
            blend(picture, glyph->bitmap, static_cast<int>(whole) + glyph->bitmap_left,
                  static_cast<int>(std::lround(y)) - glyph->bitmap_top, colour);
            x += static_cast<double>(glyph->advance.x) / 64;
        }
        FT_Set_Transform(face_, nullptr, nullptr);
    }

private:
    void set_size(double size) { FT_Set_Char_Size(face_, 0, std::lround(size * 64), 72, 72); }

    static void blend(cv::Mat3b& picture, const FT_Bitmap& bitmap, int left, int top, cv::Vec3b colour) {
        for (int row = 0; row < static_cast<int>(bitmap.rows); ++row) {
            for (int column = 0; column < static_cast<int>(bitmap.width); ++column) {
                const int px = left + column, py = top + row;
                if (px < 0 || py < 0 || px >= picture.cols || py >= picture.rows) {
                    continue;
                }
                const int cover = bitmap.buffer[row * bitmap.pitch + column];
                cv::Vec3b& pixel = picture(py, px);
                for (int channel = 0; channel < 3; ++channel) {
                    pixel[channel] = static_cast<unsigned char>(
                        (pixel[channel] * (255 - cover) + colour[channel] * cover + 127) / 255);
                }
            }
        }
    }

    FT_Library library_ = nullptr;
    FT_Face face_ = nullptr;
};

/// OpenCV's stroke font; ASCII only.
class Hershey final : public Lettering {
public:
    double width(const std::string& text, double size) override {
        return cv::getTextSize(ascii(text), cv::FONT_HERSHEY_SIMPLEX, scale(size), thickness(size), nullptr).width;
    }
    void draw(cv::Mat3b& picture, const std::string& text, double x, double y, double size, cv::Vec3b colour) override {
        cv::putText(picture, ascii(text), {static_cast<int>(std::lround(x)), static_cast<int>(std::lround(y))},
                    cv::FONT_HERSHEY_SIMPLEX, scale(size), colour, thickness(size), cv::LINE_AA);
    }

private:
    static double scale(double size) { return size / 30; } // a capital is 21 units high, 0.7 of the font size
    static int thickness(double size) { return std::max(1, static_cast<int>(std::lround(size / 16))); }
    static std::string ascii(const std::string& text) {
        std::string result;
        for (const std::uint32_t point : decode(text)) {
            if (point == 0x2026) {
                result += "...";
            } else if (point == 0xB5 || point == 0x3BC) {
                result += 'u'; // micro
            } else {
                result += point >= 0x20 && point < 0x7F ? static_cast<char>(point) : '?';
            }
        }
        return result;
    }
};

} // namespace

std::unique_ptr<Lettering> make_lettering(const std::string& font, Context& context) {
    auto letters = std::make_unique<TrueType>(font);
    if (letters->readable()) {
        return letters;
    }
    context.log(Severity::warning, "cannot read the font " + font +
                                       ", so texts are drawn in strokes; remedy: install fonts-dejavu-core or give the "
                                       "parameter font of snapshot.osmesa a TrueType file");
    return std::make_unique<Hershey>();
}

std::string fitted(Lettering& lettering, const std::string& text, double size, double room) {
    if (lettering.width(text, size) <= room) {
        return text;
    }
    std::string shorter = text;
    while (!shorter.empty()) {
        do {
            shorter.pop_back();
        } while (!shorter.empty() && (static_cast<unsigned char>(shorter.back()) >> 6) == 2);
        // A lead byte without its following bytes is removed as well.
        if (!shorter.empty() && (static_cast<unsigned char>(shorter.back()) >> 6) == 3) {
            shorter.pop_back();
        }
        if (lettering.width(shorter + "…", size) <= room) {
            break;
        }
    }
    return shorter + "…";
}

} // namespace foam::snapshot
