// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <stop_token>
#include <string>
#include <utility>

#include "hal/camera.h"
#include "hal/frame/frame_pool.h"

namespace orbwatch::bench {

/// A camera that delivers prepared pictures: only the work of their readers remains.
class PreparedCamera : public hal::Camera {
 public:
  using Paint = std::function<void(const MutablePicture&, unsigned seed)>;

  /// Paints all buffers here, each with another seed.
  PreparedCamera(std::string name, const hal::StreamFormat& format, const Paint& paint)
      : Camera({std::move(name), "prepared", "bench"}),
        format_(format),
        pool_(hal::make_frame_pool(format.format, format.width, format.height, kBuffers)) {
    std::array<std::shared_ptr<hal::FrameBuffer>, kBuffers> all;
    for (unsigned seed = 0; seed < kBuffers; ++seed) {
      all[seed] = pool_.acquire();
      hal::FrameBuffer& buffer = *all[seed];
      paint(MutablePicture::contiguous(format.format, format.width, format.height, buffer.memory,
                                       buffer.picture.planes[0].stride),
            seed);
    }
  }
  ~PreparedCamera() override { stop(); }

  /// Makes the camera's thread deliver the next picture, exposed at `moment`. Precondition: the
  /// previous one has been delivered.
  void expose(hal::TimePoint moment) {
    moment_ = moment;
    wake();
  }

 private:
  static constexpr std::size_t kBuffers = 4;

  Result<hal::StreamFormat> do_configure(const hal::StreamRequest&) override { return format_; }
  void run(const std::stop_token&) override {
    for (std::uint64_t sequence = 0; wait(); ++sequence) {
      auto buffer = pool_.acquire();
      if (!buffer) return report(hal::Fault::Stalled, "all buffers are in use");
      buffer->metadata = {.sequence = sequence, .exposure_start = moment_};
      deliver(std::move(buffer));
    }
  }

  hal::StreamFormat format_;
  hal::FramePool pool_;
  hal::TimePoint moment_;  ///< time of the next exposure; set while the camera's thread waits
};

}  // namespace orbwatch::bench
