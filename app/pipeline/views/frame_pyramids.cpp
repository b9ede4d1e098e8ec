#include "app/pipeline/views/frame_pyramids.h"

#include <algorithm>

namespace orbwatch::app {

FramePyramids::FramePyramids(std::span<const hal::StreamFormat> formats) {
  for (const hal::StreamFormat& format : formats) {
    pyramids_.emplace_back(format.format, format.width, format.height, remap::kMaxLevel);
  }
}

void FramePyramids::build(const hal::FrameSet& set, const MipLevelCounts& counts,
                          WorkerPool& workers) {
  for (std::size_t camera = 0; camera < pyramids_.size(); ++camera) {
    has_picture_[camera] = set.frames[camera] != nullptr;
    if (has_picture_[camera]) pyramids_[camera].set_source(set.frames[camera]->picture);
  }
  filled_ = {};
  extend(counts, workers);
}

void FramePyramids::extend(const MipLevelCounts& counts, WorkerPool& workers) {
  constexpr int kRowPairs = 16;  // of one band
  for (std::size_t camera = 0; camera < pyramids_.size(); ++camera) {
    if (!has_picture_[camera]) continue;
    remap::Pyramid& pyramid = pyramids_[camera];
    const int wanted = std::min(counts[camera], pyramid.levels());
    for (int level = filled_[camera] + 1; level <= wanted; ++level) {
      const int pairs = pyramid.row_pairs(level);
      auto work = [&](int band) {
        pyramid.fill(level, band * kRowPairs, std::min(pairs, (band + 1) * kRowPairs));
      };
      workers.run((pairs + kRowPairs - 1) / kRowPairs, work);
    }
    filled_[camera] = std::max(filled_[camera], wanted);
  }
}

std::span<const Picture> FramePyramids::pictures(std::size_t camera, int levels) const {
  if (!has_picture_[camera]) return {};
  const std::span<const Picture> all = pyramids_[camera].pictures();
  return all.first(std::min(all.size(), static_cast<std::size_t>(levels) + 1));
}

}  // namespace orbwatch::app
