// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "app/pipeline/views/frame_pyramids.h"
#include "app/pipeline/views/view_plan.h"
#include "app/pipeline/worker_pool.h"
#include "hal/clock.h"
#include "hal/sync/frame_set.h"
#include "hal/thread/priority_mutex.h"
#include "hal/thread/shared_threads.h"
#include "proc/remap/remap.h"

namespace orbwatch::app::pipeline {

/// Brings colour cameras that are exposed apart from each other together for display, as `orbwatch
/// project` does it with two pictures: once a second they are compared where they see the same
/// (remap::match_photometry on a small panorama), and what is found is followed slowly, so that no
/// view jumps. The first of them keeps its exposure. What is measured is never changed.
/// Thread rule: follow and table on the pipeline's thread, which samples the pictures; the rest is
/// done on a shared thread.
class ExposureMatch {
 public:
  /// Compares the colour cameras that some view of `views` shows beside each other; fewer than two:
  /// nothing is done.
  explicit ExposureMatch(std::span<const ViewPlan> views,
                         std::shared_ptr<hal::SharedThreads> threads = hal::SharedThreads::alone());

  /// Between two frame sets: takes over what was found, and samples the set's pictures when it is
  /// time and all cameras have delivered. Does not allocate.
  void follow(const hal::FrameSet& set, const FramePyramids& pyramids, WorkerPool& workers);

  /// Match for the display of a camera; null: none. Valid until the next follow().
  const remap::PhotometricTable* table(std::size_t camera) const;

  /// Number of comparisons. On any thread.
  std::uint64_t comparisons() const { return comparisons_; }

 private:
  static constexpr int kWidth = 512, kHeight = 256;  ///< of the panorama; blocks of 8 are compared
  static constexpr std::chrono::seconds kPeriod{1};
  static constexpr double kShare = 0.3;  ///< of a new comparison in what is followed

  struct Camera {
    explicit Camera(const ViewSource& shown);
    ImageView<std::uint8_t> rgb();
    ImageView<std::uint8_t> weights();

    ViewSource source;
    remap::CoordinateGrid grid;
    std::vector<std::uint8_t> samples;  ///< Rgb
    std::vector<std::uint8_t> shares;
  };
  using Tables = std::array<std::unique_ptr<const remap::PhotometricTable>, remap::kMaxSources>;

  static std::vector<Camera> colour_cameras(std::span<const ViewPlan> views);
  bool can_sample(const FramePyramids& pyramids) const;
  void compare();

  std::vector<Camera> cameras_;
  std::array<remap::PhotometricMatch, remap::kMaxSources> followed_;  ///< by place in cameras_
  bool has_compared_ = false;
  hal::TimePoint due_{};
  std::atomic<bool> sampled_{false};  ///< cameras_' pictures are the comparison's
  Tables tables_;
  hal::PriorityMutex mutex_;
  Tables found_;            ///< under mutex_
  bool has_found_ = false;  ///< under mutex_
  std::atomic<std::uint64_t> comparisons_{0};
  hal::SharedThreads::Work comparison_;
};

}  // namespace orbwatch::app::pipeline
