// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string_view>

#include "app/pipeline/pipeline.h"
#include "tests/bench/prepared_camera.h"

namespace orbwatch::bench {

/// The machine for which the frame budget is stated, run by the product's classes on one thread: a
/// colour camera of 1920x1080 in NV12 and a thermal one of 640x512 in Y16 see a ball from opposite
/// sides. Both are mixed in a measured view of 1920x1080, with a region of interest and an alarm on
/// the thermal counts, and in a panorama of 1024x512, both read as RGB or, like everything that the
/// page shows, as JPEG; a display view of 640x480 of the colour camera is read as JPEG. JPEG's
/// compression is left out. Everything else has the defaults of configuration and recipe unless
/// stated.
class ReferenceMachine {
 public:
  enum class ReadAs { Rgb, Jpeg };

  /// `on_set` is called at the beginning of each frame set, on the pipeline's thread, which does
  /// all the work.
  ReferenceMachine(ReadAs read_as, std::function<void()> on_set);
  ~ReferenceMachine();

  /// Exposes one frame set and waits for its end. False: a camera, a view or the hot spot is
  /// missing in it.
  bool run();

  /// Stretches between two readings of the pipeline thread's clock in Pipeline::process(), in their
  /// order from on_set on. Status, registers and lines are out after the first five; "rest":
  /// neither views nor their input.
  static constexpr std::string_view kStretches =
      "commands measured_halving measured_plane measurement status "
      "halving measured_picture rest panorama rest jpeg_view rest";

 private:
  class Reader;

  std::unique_ptr<Reader> reader_;
  PreparedCamera* colour_ = nullptr;   ///< owned by the pipeline
  PreparedCamera* thermal_ = nullptr;  ///< owned by the pipeline
  std::optional<app::pipeline::Pipeline> pipeline_;
  const hal::TimePoint begin_ = hal::Clock::now();
  std::uint64_t sets_ = 0;
};

}  // namespace orbwatch::bench
