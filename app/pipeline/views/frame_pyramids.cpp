// SPDX-License-Identifier: Apache-2.0
#include "app/pipeline/views/frame_pyramids.h"

#include <algorithm>

namespace orbwatch::app::pipeline {
namespace {

/// Row pairs of level 1 in a strip, whole pairs up to the highest level; and rows of the picture.
constexpr int kStripPairs = 16;
constexpr int kStripRows = 4 * kStripPairs;
static_assert(kStripPairs % (1 << (remap::kMaxLevel - 1)) == 0);

int strips_of(const remap::Pyramid& pyramid) {
  return (pyramid.pictures().front().height + kStripRows - 1) / kStripRows;
}

/// The rows of a strip in the levels above `filled` up to `wanted`.
void fill_strip(remap::Pyramid& pyramid, int strip, int filled, int wanted) {
  for (int level = filled + 1; level <= wanted; ++level) {
    const int pairs = kStripPairs >> (level - 1);
    const int end = std::min(pyramid.row_pairs(level), (strip + 1) * pairs);
    if (strip * pairs < end) pyramid.fill(level, strip * pairs, end);
  }
}

/// The rows of a strip in `wanted` that are not in `filled`.
void fill_strip(remap::SharpenedPicture& picture, int strip, const remap::SourceArea& filled,
                const remap::SourceArea& wanted) {
  const remap::SourceArea rows{wanted.left, strip * kStripRows, wanted.right,
                               (strip + 1) * kStripRows};
  for_each_rest(wanted, filled, [&](const remap::SourceArea& rest) {
    if (const auto part = common(rest, rows); !part.is_empty()) picture.fill(part);
  });
}

}  // namespace

FramePyramids::FramePyramids(std::span<const hal::StreamFormat> formats, const PictureUses& uses) {
  for (const hal::StreamFormat& stream : formats) {
    const PictureUse& use = uses[cameras_.size()];
    Camera& camera = cameras_.emplace_back(
        Camera{{stream.format, stream.width, stream.height, remap::kMaxLevel}, {}});
    if (!remap::can_sharpen(stream.format)) continue;
    for (const auto& [sharpness, area] : use.sharpened()) {
      camera.sharpened.push_back(
          {sharpness, {stream.format, stream.width, stream.height, sharpness}, {}, {}, {}});
    }
  }
}

void FramePyramids::build(const hal::FrameSet& set, const PictureUses& uses, WorkerPool& workers) {
  for (std::size_t n = 0; n < cameras_.size(); ++n) {
    cameras_[n].has_picture = set.frames[n] != nullptr;
    if (set.frames[n]) cameras_[n].set_source(set.frames[n]->picture);
  }
  extend(uses, workers);
}

/// A strip of a picture needs nothing of the others, up to the highest level: whoever fills it goes
/// from level to level while it is in the cache, and nobody waits for a whole level.
void FramePyramids::extend(const PictureUses& uses, WorkerPool& workers) {
  std::array<int, hal::kMaxCameras + 1> first{};  // strip of a camera, among those of all
  for (std::size_t n = 0; n < hal::kMaxCameras; ++n) {
    const bool is_wanted = n < cameras_.size() && cameras_[n].want(uses[n]);
    first[n + 1] = first[n] + (is_wanted ? strips_of(cameras_[n].pyramid) : 0);
  }
  auto work = [&](int strip) {
    const auto after = std::ranges::upper_bound(first, strip);
    const auto n = static_cast<std::size_t>(after - first.begin()) - 1;
    cameras_[n].fill(strip - first[n]);
  };
  workers.run(first.back(), work);
  for (Camera& camera : cameras_) camera.end_filling();
}

std::span<const Picture> FramePyramids::pictures(std::size_t camera, int levels,
                                                 double sharpness) const {
  const Camera& from = cameras_[camera];
  if (!from.has_picture) return {};
  const std::size_t count =
      std::min(from.pyramid.pictures().size(), static_cast<std::size_t>(levels) + 1);
  const auto found = std::ranges::find(from.sharpened, sharpness, &Sharpened::sharpness);
  if (found == from.sharpened.end()) return from.pyramid.pictures().first(count);
  return {found->levels.data(), count};
}

void FramePyramids::Camera::set_source(const Picture& picture) {
  pyramid.set_source(picture);
  filled = wanted = 0;
  for (Sharpened& by : sharpened) {
    by.picture.set_source(picture);
    by.filled = by.wanted = {};
    std::ranges::copy(pyramid.pictures(), by.levels.begin());
    by.levels[0] = by.picture.picture();
  }
}

bool FramePyramids::Camera::want(const PictureUse& use) {
  if (!has_picture) return false;
  wanted = std::max(filled, std::min(use.mip_levels, pyramid.levels()));
  bool is_more = wanted > filled;
  for (const auto& [sharpness, area] : use.sharpened()) {
    const auto by = std::ranges::find(sharpened, sharpness, &Sharpened::sharpness);
    if (by == sharpened.end()) continue;
    by->wanted = united(by->filled, area);
    is_more |= by->wanted != by->filled;
  }
  return is_more;
}

void FramePyramids::Camera::fill(int strip) {
  fill_strip(pyramid, strip, filled, wanted);
  for (Sharpened& by : sharpened) fill_strip(by.picture, strip, by.filled, by.wanted);
}

void FramePyramids::Camera::end_filling() {
  filled = wanted;
  for (Sharpened& by : sharpened) by.filled = by.wanted;
}

}  // namespace orbwatch::app::pipeline
