// SPDX-License-Identifier: Apache-2.0
#include "app/pipeline/views/exposure_match.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace orbwatch::app::pipeline {
namespace {

optics::ViewProjection panorama(int width, int height) {
  return *optics::ViewProjection::make(
      {optics::ViewKind::Equirectangular, {}, {}, {}, width, height});
}

/// A share of the way from one match to another; gains by their logarithm.
void approach(remap::PhotometricMatch& match, const remap::PhotometricMatch& to, double share) {
  for (std::size_t k = 0; k < match.channels.size(); ++k) {
    auto& [gain, offset] = match.channels[k];
    gain *= std::pow(to.channels[k].gain / gain, share);
    offset += (to.channels[k].offset - offset) * share;
  }
}

/// True if the match is too small to be visible.
bool is_unchanged(const remap::PhotometricMatch& match) {
  return std::ranges::all_of(match.channels, [](const auto& channel) {
    return std::abs(channel.gain - 1) < 0.01 && std::abs(channel.offset) < 0.001;
  });
}

}  // namespace

ExposureMatch::Camera::Camera(const ViewSource& shown)
    : source(shown),
      grid(panorama(kWidth, kHeight), shown.ball, shown.format.width, shown.format.height),
      samples(std::size_t{3} * kWidth * kHeight),
      shares(std::size_t{kWidth} * kHeight) {}

ImageView<std::uint8_t> ExposureMatch::Camera::rgb() {
  return {samples.data(), kWidth, kHeight, 3, 3 * kWidth};
}

ImageView<std::uint8_t> ExposureMatch::Camera::weights() {
  return {shares.data(), kWidth, kHeight, 1, kWidth};
}

std::vector<ExposureMatch::Camera> ExposureMatch::colour_cameras(std::span<const ViewPlan> views) {
  std::vector<const ViewSource*> by_camera(hal::kMaxCameras);
  for (const ViewPlan& view : views) {
    if (!view.match || std::ranges::count_if(view.sources, is_colour) < 2) continue;
    for (const ViewSource& source : view.sources) {
      if (is_colour(source)) by_camera[source.camera] = &source;
    }
  }
  std::vector<Camera> cameras;
  for (const ViewSource* source : by_camera) {
    if (source && cameras.size() < remap::kMaxSources) cameras.emplace_back(*source);
  }
  return cameras;
}

ExposureMatch::ExposureMatch(std::span<const ViewPlan> views,
                             std::shared_ptr<hal::SharedThreads> threads)
    : cameras_(colour_cameras(views)), comparison_(std::move(threads), [this] { compare(); }) {
  if (cameras_.empty()) return;
  std::vector<remap::BlendSource> sources;
  for (const Camera& camera : cameras_) {
    const hal::StreamFormat& format = camera.source.format;
    sources.push_back({camera.source.ball, format.width, format.height, 1, std::nullopt});
  }
  const remap::BlendGrid blend(panorama(kWidth, kHeight), sources);
  for (std::size_t n = 0; n < cameras_.size(); ++n) {
    blend.weights(n, cameras_[n].grid, cameras_[n].weights());
  }
}

void ExposureMatch::follow(const hal::FrameSet& set, const FramePyramids& pyramids,
                           WorkerPool& workers) {
  if (cameras_.empty()) return;
  {
    const std::lock_guard lock(mutex_);
    if (std::exchange(has_found_, false)) std::swap(tables_, found_);
  }
  if (set.stamp < due_ || sampled_ || !can_sample(pyramids)) return;
  due_ = set.stamp + kPeriod;
  for (Camera& camera : cameras_) {
    const auto pictures = pyramids.pictures(camera.source.camera, 0);
    const MutablePicture rgb = picture_of(PixelFormat::Rgb, camera.rgb());
    auto work = [&](int row) {
      remap::remap(camera.grid, pictures, remap::Interpolation::Bilinear, rgb, {row, row + 1});
    };
    workers.run(camera.grid.tiles_y(), work);
  }
  sampled_ = true;
  comparison_.request();
}

bool ExposureMatch::can_sample(const FramePyramids& pyramids) const {
  return std::ranges::all_of(cameras_, [&](const Camera& camera) {
    const auto pictures = pyramids.pictures(camera.source.camera, 0);
    const hal::StreamFormat& format = camera.source.format;
    return !pictures.empty() && pictures.front().format == format.format &&
           pictures.front().width == format.width && pictures.front().height == format.height;
  });
}

const remap::PhotometricTable* ExposureMatch::table(std::size_t camera) const {
  for (std::size_t n = 0; n < cameras_.size(); ++n) {
    if (cameras_[n].source.camera == camera) return tables_[n].get();
  }
  return nullptr;
}

/// A camera that shares too little with the others keeps what was found before.
void ExposureMatch::compare() {
  using Outcome = remap::PhotometricMatch::Outcome;
  std::vector<remap::MergeSource<std::uint8_t>> pictures;
  for (Camera& camera : cameras_) pictures.push_back({camera.rgb(), camera.weights()});
  const auto matches =
      remap::match_photometry<std::uint8_t>(pictures, remap::transfer_of(PixelFormat::Rgb));
  Tables tables;
  for (std::size_t n = 0; n < cameras_.size(); ++n) {
    if (matches[n].outcome == Outcome::Matched) {
      approach(followed_[n], matches[n], has_compared_ ? kShare : 1);
    }
    if (is_unchanged(followed_[n])) continue;
    tables[n] = std::make_unique<remap::PhotometricTable>(followed_[n], PixelFormat::Rgb);
  }
  has_compared_ = true;
  {
    const std::lock_guard lock(mutex_);
    std::swap(found_, tables);
    has_found_ = true;
  }
  ++comparisons_;
  sampled_ = false;
}

}  // namespace orbwatch::app::pipeline
