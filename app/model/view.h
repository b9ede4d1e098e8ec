#pragma once

#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "hal/clock.h"
#include "proc/image/image_view.h"
#include "proc/optics/view_projection.h"

namespace orbwatch::app {

/// Buffers of one view, shared with the sinks: one is rendered, one is the newest that all have,
/// and five DDS topics and the snapshots may each be at work on an older one.
inline constexpr std::size_t kViewBuffers = 8;

/// What a virtual camera in the ball's centre sees at one moment. Read-only once published; the
/// memory comes from the view's pool and returns to it with the last ViewPtr.
struct View {
  View() = default;
  View(View&&) = default;
  View& operator=(View&&) = default;
  View(const View&) = delete;  // its planes point into its own memory
  View& operator=(const View&) = delete;

  std::size_t index = 0;  ///< place in the configuration's list of views
  std::string_view name;  ///< lives as long as the pipeline
  std::uint64_t frame_set = 0;
  hal::TimePoint stamp;        ///< exposure start of the frame set
  std::uint64_t pointing = 0;  ///< number of the request that it shows; 0: as configured
  optics::ViewSpec spec;       ///< where it looks

  ImageView<std::uint8_t> colour;    ///< RGB, what people look at: blended, colour-mapped
  ImageView<std::uint8_t> validity;  ///< one Validity per pixel
  /// What is measured, one of the two, raw and never colour-mapped; empty unless the view measures.
  ImageView<std::uint8_t> luminance;     ///< 8 bit
  ImageView<std::uint16_t> radiometric;  ///< 16 bit counts as the camera gave them

  std::vector<std::uint8_t> bytes;   ///< behind colour, validity and luminance
  std::vector<std::uint16_t> words;  ///< behind radiometric
};

using ViewPtr = std::shared_ptr<const View>;

}  // namespace orbwatch::app
