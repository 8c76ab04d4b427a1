// The painter library: a figure becomes geometry in pixels, OpenGL draws it, OpenCV adds text and writes PNG.
#include "painter.hpp"

#include "colour_bar.hpp"
#include "rasterizer.hpp"

#include <foam/base/error.hpp>

#include <opencv2/imgcodecs.hpp>

#include <string>
#include <vector>

namespace foam::snapshot {
namespace {

const cv::Vec3b ink{50, 40, 35};

std::string encode(const cv::Mat3b& picture) {
    std::vector<unsigned char> bytes;
    if (!cv::imencode(".png", picture, bytes, {cv::IMWRITE_PNG_COMPRESSION, 3})) {
        throw Error(ErrorCode::output, "snapshot.osmesa: OpenCV cannot encode the picture as PNG");
    }
    return {bytes.begin(), bytes.end()};
}

void draw_centered(cv::Mat3b& picture, Lettering& lettering, const std::string& text, double left, double room,
                   double baseline, double size) {
    const std::string shown = fitted(lettering, text, size, room);
    lettering.draw(picture, shown, left + (room - lettering.width(shown, size)) / 2, baseline, size, ink);
}

void add_words(cv::Mat3b& picture, const Figure& figure, const Layout& layout, Lettering& lettering) {
    const double margin = 24 * layout.unit;
    if (!figure.title.empty()) {
        draw_centered(picture, lettering, figure.title, margin, layout.width - 2 * margin, margin + 24 * layout.unit,
                      26 * layout.unit);
    }
    for (std::size_t i = 0; i < figure.panels.size(); ++i) {
        const Layout::Cell& cell = layout.cells[i];
        const double size = 19 * layout.unit;
        draw_centered(picture, lettering, figure.panels[i].caption, cell.caption_left, cell.caption_width,
                      cell.caption_top + size, size);
    }
    if (layout.colour_bar) {
        draw_colour_bar(picture, layout, lettering);
    }
}

class OpenGlPainter final : public Painter {
public:
    explicit OpenGlPainter(const Settings& settings) : settings_(settings) {}

    Image paint(const Figure& figure, Context& context) const override {
        if (figure.width < 16 || figure.height < 16 || figure.width > rasterizer_.largest() ||
            figure.height > rasterizer_.largest()) {
            throw Error(ErrorCode::usage, "snapshot.osmesa: cannot draw a picture of " + std::to_string(figure.width) +
                                              " x " + std::to_string(figure.height) +
                                              " pixels; remedy: between 16 and " +
                                              std::to_string(rasterizer_.largest()) + " along each side");
        }
        const Layout layout = arrange(figure, Camera(settings_.azimuth, settings_.elevation), settings_.turntable);
        const Scene scene = make_scene(figure, layout, context);
        context.check_cancelled();
        cv::Mat3b picture = rasterizer_.draw(scene, settings_.supersampling, settings_.mesh_opacity);
        add_words(picture, figure, layout, *make_lettering(settings_.font, context));
        return {figure.width, figure.height, encode(picture)};
    }

private:
    Settings settings_;
    Rasterizer rasterizer_;
};

} // namespace
} // namespace foam::snapshot

extern "C" __attribute__((visibility("default"))) foam::snapshot::Painter*
foam_make_snapshot_painter(const foam::snapshot::Settings& settings) {
    return new foam::snapshot::OpenGlPainter(settings);
}
