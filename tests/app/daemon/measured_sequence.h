// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
#include <cstring>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "app/pictures/colour_maps.h"
#include "hal/frame/frame_pool.h"
#include "proc/optics/vec.h"
#include "proc/signals/region_meter.h"
#include "tests/app/pipeline/views/rendered_view.h"
#include "tests/support/rendered_sequence.h"

namespace orbwatch::tests {

inline optics::ViewProjection process_view() {
  return optics::ViewProjection::make(
             {optics::ViewKind::Perspective, {-118, -44, 0}, 90, {}, 640, 480})
      .value();
}

/// Sequence that is remapped and measured frame by frame.
class MeasuredSequence {
 public:
  MeasuredSequence(const RenderedSequence& sequence, PixelFormat format,
                   const signals::RegionSettings& region)
      : sequence_(sequence),
        format_(format),
        view_(plan(sequence, format)),
        meter_(
            signals::RegionMeter::make(view_.plan().projection, sequence.scene(), region).value()) {
  }

  signals::Signals measure(std::size_t number) { return measure(number, read(number)); }

  /// The frame's picture.
  cv::Mat read(std::size_t number) const {
    return cv::imread(sequence_.frames()[number].picture.string(),
                      format_ == PixelFormat::Y16 ? cv::IMREAD_UNCHANGED : cv::IMREAD_GRAYSCALE);
  }

  /// Measures another picture in place of the frame's.
  signals::Signals measure(std::size_t number, const cv::Mat& picture) {
    picture_ = picture;
    auto buffer = hal::make_frame_pool(format_, picture_.cols, picture_.rows, 1).acquire();
    std::memcpy(buffer->memory, picture_.data, picture_.total() * picture_.elemSize());
    hal::FrameSet set;
    set.frames[0] = buffer;
    app::pipeline::WorkerPool workers(0);
    const app::View& view = view_.render(set, workers);
    const double seconds = static_cast<double>(number) / sequence_.frame_rate();
    return view.radiometric.empty() ? meter_.measure(view.luminance, view.validity, seconds)
                                    : meter_.measure(view.radiometric, view.validity, seconds);
  }

  /// Brightest pixel around a place in the camera's picture.
  double counts_at(const optics::Vec2& pixel) const {
    const cv::Rect around(static_cast<int>(std::lround(pixel.u)) - 1,
                          static_cast<int>(std::lround(pixel.v)) - 1, 3, 3);
    double brightest = 0;
    cv::minMaxLoc(picture_(around), nullptr, &brightest);
    return brightest;
  }

 private:
  static app::pipeline::ViewPlan plan(const RenderedSequence& sequence, PixelFormat format) {
    const cv::Mat first = cv::imread(sequence.frames()[0].picture.string(), cv::IMREAD_UNCHANGED);
    app::pipeline::ViewPlan plan{0, "process", process_view(), {}, {}, {}, 0};
    plan.interpolation = remap::Interpolation::Area;
    plan.sources.push_back({0,
                            {format, {}, first.cols, first.rows, sequence.frame_rate()},
                            sequence.camera(),
                            1,
                            {app::colour_map_table("grey"), 0, 65535}});
    return plan;
  }

  const RenderedSequence& sequence_;
  PixelFormat format_;
  app::pipeline::RenderedView view_;
  signals::RegionMeter meter_;
  cv::Mat picture_;
};

}  // namespace orbwatch::tests
