// SPDX-License-Identifier: Apache-2.0
#include "app/ports/recorder/export/pictures/camera_video.h"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <vector>

#include "app/ports/recorder/export/pictures/avi_writer.h"
#include "app/ports/recorder/export/pictures/camera_pictures.h"
#include "app/ports/recorder/export/pictures/video_frames.h"

namespace orbwatch::app::recorder {
namespace {

using std::chrono::microseconds;

/// Median interval of the pictures; of a single one that of the camera, or a second.
microseconds period_of(const CameraPictures& pictures) {
  const auto exposures = pictures.exposures();
  std::vector<std::uint64_t> intervals;
  for (std::size_t k = 1; k < exposures.size(); ++k) {
    intervals.push_back(exposures[k].start - exposures[k - 1].start);
  }
  constexpr microseconds kShortest{1}, kLongest = std::chrono::hours(1);
  if (intervals.empty()) {
    const double rate = pictures.index().format.frame_rate;
    const auto period = microseconds(static_cast<std::int64_t>(rate > 0 ? 1e6 / rate : 1e6));
    return std::clamp(period, kShortest, kLongest);
  }
  const auto median = intervals.begin() + static_cast<std::ptrdiff_t>(intervals.size() / 2);
  std::ranges::nth_element(intervals, median);
  const std::chrono::nanoseconds period(static_cast<std::int64_t>(*median));
  return std::clamp(std::chrono::round<microseconds>(period), kShortest, kLongest);
}

}  // namespace

Result<> write_camera_video(const std::filesystem::path& recording, const std::string& camera,
                            const StampRange& range, VideoText text,
                            const std::filesystem::path& output, const ExportSteps& steps) {
  auto pictures = CameraPictures::open(recording, camera, range);
  if (!pictures) return tl::unexpected(pictures.error());
  auto frames = VideoFrames::make(*pictures, text, steps);
  if (!frames) return tl::unexpected(frames.error());
  auto avi = AviWriter::create(output, {frames->width(), frames->height(), period_of(*pictures)});
  if (!avi) return tl::unexpected(avi.error());
  for (std::size_t done = 0; !pictures->is_done(); ++done) {
    if (!steps(done, pictures->count(), "pictures")) return cancelled_export();
    const auto frame = frames->next();
    if (!frame) return tl::unexpected(frame.error());
    if (auto added = avi->add(*frame); !added) return added;
  }
  return avi->finish();
}

}  // namespace orbwatch::app::recorder
