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

/// How a view shows a one-channel camera.
struct SourceColours {
  std::size_t map = 0;                  ///< place in kColourMapNames
  std::array<double, 2> range{0, 100};  ///< first and last colour: degC, or percent of full scale
};

/// What a virtual camera in the ball's centre sees at one moment. Read-only once published; the
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
  std::uint64_t pointing = 0;  ///< number of the request that it shows; 0: as configured
  optics::ViewSpec spec;       ///< where it looks
  /// Of its sources, in their order; 0 beyond the last one.
  std::array<double, remap::kMaxSources> weights{};
  /// Of its sources, in their order; nullopt: the camera's own colours, or beyond the last one.
  std::array<std::optional<SourceColours>, remap::kMaxSources> colours{};

  /// What people look at, blended and colour-mapped, in a format that serves those who read it (see
  /// PictureNeeds): Rgb, Bgr, I420 as JPEG has it, or Grey. No data: nobody does.
  MutablePicture picture;
  /// One Validity per pixel; not defined without a picture, unless the view measures.
  ImageView<std::uint8_t> validity;
  /// What is measured, one of the two, raw and never colour-mapped; empty unless the view measures.
  ImageView<std::uint8_t> luminance;     ///< 8 bit
  ImageView<std::uint16_t> radiometric;  ///< 16 bit counts as the camera gave them
  /// Counts of temperature beside the picture, also where another camera is shown; 0 where the
  /// radiometric one does not see. Empty unless measured, or somebody needs them.
  ImageView<std::uint16_t> counts;
  double kelvin_per_count = 0;  ///< of `counts`, also while nobody needs them; 0: it has none
  double kelvin_offset = 0;     ///< K, of a count of 0

  UntouchedVector<std::uint8_t> bytes;   ///< behind picture and validity
  UntouchedVector<std::uint16_t> words;  ///< behind luminance, or radiometric and counts
};

using ViewPtr = std::shared_ptr<const View>;

/// How many views readers can hold at once.
struct KeptViews {
  std::size_t of_each = 0;  ///< of every view
  std::size_t besides = 0;  ///< of all views together, whichever they are

  KeptViews& operator+=(const KeptViews& other) {
    of_each += other.of_each;
    besides += other.besides;
    return *this;
  }
};

}  // namespace orbwatch::app
