// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <cstddef>
#include <cstring>
#include <optional>

#include "app/watch/camera_watch.h"
#include "hal/frame/frame_pool.h"
#include "tests/app/alignment/rig_with_pose.h"
#include "tests/support/temporary_folder.h"

namespace orbwatch::app::tests {

/// Two watched cameras whose pictures are given by hand.
class TwoWatchedCameras : public testing::Test {
 protected:
  static constexpr std::size_t kCameras = 2;

  TwoWatchedCameras() {
    site.rig = rig_with_pose({120, -500, 430});
    for (std::size_t i = 0; i < kCameras; ++i) {
      site.rig.cameras.resize(i + 1, site.rig.cameras.front());
      site.rig.cameras[i].name = i == 0 ? "a" : "b";
      site.cameras.push_back({site.rig.cameras[i].name, i, {}});
    }
    watch_anew();
  }

  void watch_anew() { watch.emplace(site, folder.path(), hal::SharedThreads::alone()); }

  hal::Frame frame() {
    auto buffer = hal::make_frame_pool(PixelFormat::Grey, 800, 800, 1).acquire();
    std::memset(buffer->memory, 0, buffer->capacity);
    buffer->metadata.exposure_start = stamp;
    return buffer;
  }

  orbwatch::tests::TemporaryFolder folder;
  AlignedSite site;
  hal::TimePoint stamp{std::chrono::hours(1)};
  std::optional<CameraWatch> watch;
};

}  // namespace orbwatch::app::tests
