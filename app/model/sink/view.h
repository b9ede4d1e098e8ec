// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>

#include "hal/clock.h"
#include "proc/image/image_view.h"
#include "proc/image/picture.h"
#include "proc/image/untouched_memory.h"
#include "proc/optics/view_projection.h"
#include "proc/remap/remap.h"

namespace orbwatch::app {

/// Colours of a one-channel camera in a view.
struct SourceColours {
  std::size_t map = 0;                  ///< place in kColourMapNames
  std::array<double, 2> range{0, 100};  ///< first and last colour: degC, or percent of full scale
};

/// Picture of a virtual camera in the ball's centre at one moment. Read-only once published; the
/// memory comes from the pipeline's ViewBuffers and returns to them with the last ViewPtr.
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
  std::uint64_t pointing = 0;  ///< number of the pointing request in effect; 0: as configured
  optics::ViewSpec spec;       ///< projection and direction
  /// Weights of the sources, in their order; 0 beyond the last one.
  std::array<double, remap::kMaxSources> weights{};
  /// Colours of the sources, in their order; nullopt: the camera's own colours, or beyond the last
  /// one.
  std::array<std::optional<SourceColours>, remap::kMaxSources> colours{};

  /// Display picture, blended and colour-mapped, in a format that serves its readers (see
  /// PictureNeeds): Rgb, Bgr, I420 with JPEG's colour range, or Grey. No data: it has no readers.
  MutablePicture picture;
  /// One Validity per pixel; not defined without a picture, unless the view measures.
  ImageView<std::uint8_t> validity;
  /// Measured plane, one of the two, raw and never colour-mapped; empty unless the view measures.
  ImageView<std::uint8_t> luminance;     ///< 8 bit
  ImageView<std::uint16_t> radiometric;  ///< 16-bit counts as the camera delivered them
  /// Temperature counts beside the picture, also where another camera is shown; 0 where the
  /// radiometric camera does not see. Empty unless the view measures or a reader needs them.
  ImageView<std::uint16_t> counts;
  /// Scale of `counts`, set even while `counts` is empty; 0: no radiometric camera.
  double kelvin_per_count = 0;
  double kelvin_offset = 0;  ///< temperature at count 0, K

  UntouchedVector<std::uint8_t> bytes;   ///< memory of picture and validity
  UntouchedVector<std::uint16_t> words;  ///< memory of luminance, or of radiometric and counts
};

using ViewPtr = std::shared_ptr<const View>;

/// Limits of the views that readers hold at once.
struct KeptViews {
  std::size_t of_each = 0;  ///< per view
  std::size_t besides = 0;  ///< in addition, over all views together

  KeptViews& operator+=(const KeptViews& other) {
    of_each += other.of_each;
    besides += other.besides;
    return *this;
  }
};

}  // namespace orbwatch::app
