// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/v360_remap.h"

#include <array>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>

extern "C" {
#include <libavfilter/avfilter.h>
#include <libavfilter/buffersink.h>
#include <libavfilter/buffersrc.h>
#include <libavutil/frame.h>
#include <libavutil/pixfmt.h>
}

namespace orbwatch::bench {
namespace {

/// Throws FFmpeg's message for `code`, with `what`.
void check(int code, const std::string& what) {
  if (code >= 0) return;
  std::array<char, AV_ERROR_MAX_STRING_SIZE> text{};
  av_strerror(code, text.data(), text.size());
  throw std::runtime_error("v360: " + what + ": " + text.data());
}

/// v360's format, with the number and size of its planes; all but the first are subsampled.
struct PlanarFormat {
  AVPixelFormat format = AV_PIX_FMT_NONE;
  int planes = 0;
  int shift = 0;
  int sample_bytes = 1;
};
PlanarFormat planar_format(PixelFormat format) {
  switch (format) {
    case PixelFormat::Grey:
      return {AV_PIX_FMT_GRAY8, 1};
    case PixelFormat::Y16:
      return {AV_PIX_FMT_GRAY16, 1, 0, 2};
    case PixelFormat::Nv12:
      return {AV_PIX_FMT_YUV420P, 3, 1};
    case PixelFormat::Bgr:
      return {AV_PIX_FMT_GBRP, 3};
    default:
      return {};
  }
}

std::string filter_options(const Rig& rig) {
  const NamedView& named = rig.named;
  const bool flat = named.kind == optics::ViewKind::Perspective;
  std::ostringstream text;
  // v360 shows a ball as seen from behind its picture: ih_flip corrects right and left.
  text << "input=ball:ih_flip=1:output=" << (flat ? "flat" : "equirect")
       << ":interp=linear:w=" << named.width << ":h=" << named.height
       << ":yaw=" << named.orientation.yaw << ":pitch=" << named.orientation.pitch
       << ":roll=" << named.orientation.roll;
  if (flat) {
    constexpr double kDegrees = 180 / 3.14159265358979323846;
    const double v_fov = 2 * kDegrees * std::atan(double(named.height) / named.width);
    text << ":h_fov=90:v_fov=" << v_fov;
  }
  return text.str();
}

}  // namespace

void V360Remap::Free::operator()(AVFilterGraph* graph) const { avfilter_graph_free(&graph); }
void V360Remap::Free::operator()(AVFrame* frame) const { av_frame_free(&frame); }

bool V360Remap::takes(PixelFormat format) { return planar_format(format).planes > 0; }

V360Remap::V360Remap(const Rig& rig, PixelFormat format)
    : graph_(avfilter_graph_alloc()), input_(av_frame_alloc()), view_(av_frame_alloc()) {
  if (!graph_ || !input_ || !view_) throw std::runtime_error("v360: no memory");
  wrap_source(rig, format);
  connect(rig);
}

void V360Remap::wrap_source(const Rig& rig, PixelFormat format) {
  const PlanarFormat planar = planar_format(format);
  input_->format = planar.format;
  input_->width = rig.source;
  input_->height = rig.source;
  source_.reserve(planar.planes);
  for (int n = 0; n < planar.planes; ++n) {
    const int side = n == 0 ? rig.source : rig.source >> planar.shift;
    Plane& plane = source_.emplace_back(Plane::blank(side, side, 1, planar.sample_bytes));
    plane.fill_with_noise(n);
    input_->data[n] = reinterpret_cast<std::uint8_t*>(plane.bytes.data());
    input_->linesize[n] = static_cast<int>(plane.stride);
    // The samples are still owned by us.
    input_->buf[n] = av_buffer_create(
        input_->data[n], plane.bytes.size(), [](void*, std::uint8_t*) {}, nullptr,
        AV_BUFFER_FLAG_READONLY);
    if (!input_->buf[n]) throw std::runtime_error("v360: no memory for a reference to the source");
  }
}

void V360Remap::connect(const Rig& rig) {
  graph_->nb_threads = 1;
  graph_->thread_type = 0;
  // Formats that v360 does not support must fail, not be converted implicitly.
  avfilter_graph_set_auto_convert(graph_.get(), AVFILTER_AUTO_CONVERT_NONE);
  std::ostringstream input;
  input << "video_size=" << rig.source << 'x' << rig.source << ":pix_fmt=" << input_->format
        << ":time_base=1/25:pixel_aspect=1/1";
  AVFilterContext* v360 = nullptr;
  const auto add = [&](AVFilterContext*& filter, const char* name, const std::string& options) {
    check(avfilter_graph_create_filter(&filter, avfilter_get_by_name(name), name, options.c_str(),
                                       nullptr, graph_.get()),
          std::string(name) + " " + options);
  };
  add(in_, "buffer", input.str());
  add(v360, "v360", filter_options(rig));
  add(out_, "buffersink", "");
  check(avfilter_link(in_, 0, v360, 0), "link");
  check(avfilter_link(v360, 0, out_, 0), "link");
  check(avfilter_graph_config(graph_.get(), nullptr), "configure " + filter_options(rig));
}

void V360Remap::run() {
  av_frame_unref(view_.get());
  check(av_buffersrc_add_frame_flags(in_, input_.get(), AV_BUFFERSRC_FLAG_KEEP_REF), "send");
  check(av_buffersink_get_frame(out_, view_.get()), "receive");
}

}  // namespace orbwatch::bench
