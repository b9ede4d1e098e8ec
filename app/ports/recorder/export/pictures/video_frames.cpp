// SPDX-License-Identifier: Apache-2.0
#include "app/ports/recorder/export/pictures/video_frames.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <string_view>

#include "app/pictures/picture_conversion.h"
#include "app/ports/recorder/export/state_values.h"
#include "app/ports/recorder/recorded_utc.h"
#include "hal/recording/picture_region.h"

namespace orbwatch::app::recorder {
namespace {

constexpr int kVideoQuality = 90;
/// Most lines of text; a recording of any origin may have more values.
constexpr std::size_t kMostLines = 200;

/// A value for people; empty: not valid.
std::string shown(const Figure& figure) {
  if (std::isnan(figure.value)) return figure.text;
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.5g", figure.value);
  return figure.unit.empty() ? text.data() : std::string(text.data()) + " " + figure.unit;
}

/// Text of a picture.
std::vector<std::string> lines_of(const ExportedPicture& picture) {
  std::vector<std::string> lines{utc_text_at(picture.exposure.set_time)};
  if (picture.state == nullptr) return lines;
  lines.push_back("frame set " + std::to_string(picture.state->frame_set));
  constexpr std::string_view kRegionTitle = "region.";
  for_each_value(*picture.state, [&](const std::string& title, const Figure& figure) {
    const std::string value = shown(figure);
    if (value.empty() || lines.size() == kMostLines) return;
    const bool is_signal = title.starts_with(kRegionTitle);
    lines.push_back(title.substr(is_signal ? kRegionTitle.size() : 0) + " " + value);
  });
  return lines;
}

Result<> check_sizes(const CameraPictures& pictures) {
  const auto& first = pictures.exposures().front().region;
  for (const auto& exposure : pictures.exposures()) {
    const auto& region = exposure.region;
    if (region.width == first.width && region.height == first.height) continue;
    return fail("the pictures of " + pictures.camera() + " change their size from " +
                std::to_string(first.width) + "x" + std::to_string(first.height) + " to " +
                std::to_string(region.width) + "x" + std::to_string(region.height) + " at " +
                utc_text_at(exposure.set_time) + "; choose a range by --from and --to");
  }
  return {};
}

}  // namespace

Result<VideoFrames> VideoFrames::make(CameraPictures& pictures, VideoText text,
                                      const ExportSteps& steps) {
  if (auto checked = check_sizes(pictures); !checked) return tl::unexpected(checked.error());
  VideoFrames frames(pictures);
  const bool has_text = text == VideoText::Values;
  if (has_text || is_stretched(pictures.index().format.format)) {
    if (auto seen = frames.survey(has_text, steps); !seen) return tl::unexpected(seen.error());
  }
  return frames;
}

/// Finds the range of brightness, and the room that the text needs.
Result<> VideoFrames::survey(bool has_text, const ExportSteps& steps) {
  std::size_t lines = 0;
  for (std::size_t done = 0; !pictures_->is_done(); ++done) {
    if (!steps(done, pictures_->count(), "pictures looked through")) return cancelled_export();
    const auto picture = pictures_->next();
    if (!picture) return tl::unexpected(picture.error());
    if (has_text) lines = std::max(lines, lines_of(*picture).size());
    if (!is_stretched(picture->part.format)) continue;
    const auto pixels = pictures_->pixels(*picture);
    if (!pixels) return tl::unexpected(pixels.error());
    extend(grey_, pixels->samples<std::uint16_t>());
  }
  if (has_text) caption_.emplace(pictures_->exposures().front().region.width, lines);
  return pictures_->rewind();
}

int VideoFrames::width() const {
  return caption_ ? caption_->width() : pictures_->exposures().front().region.width;
}

int VideoFrames::height() const {
  return pictures_->exposures().front().region.height + (caption_ ? caption_->height() : 0);
}

Result<std::span<const std::byte>> VideoFrames::next() {
  const auto exported = pictures_->next();
  if (!exported) return tl::unexpected(exported.error());
  if (!caption_ && !exported->part.jpeg.empty()) return exported->part.jpeg;
  const auto pixels = pictures_->pixels(*exported);
  if (!pixels) return tl::unexpected(pixels.error());
  Picture picture = in_8_bit(*pixels);
  if (caption_) picture = with_text(picture, *exported);
  return encoder_.encode(picture, kVideoQuality).map([](std::span<const std::uint8_t> jpeg) {
    return std::as_bytes(jpeg);
  });
}

/// The picture as Grey or Rgb.
Picture VideoFrames::in_8_bit(const Picture& picture) {
  const bool is_grey = info(picture.format).colour == ColourModel::Luminance;
  const PixelFormat format = is_grey ? PixelFormat::Grey : PixelFormat::Rgb;
  if (picture.format == format) return picture;
  if (is_stretched(picture.format)) {
    converted_ = stretched(picture.samples<std::uint16_t>(), grey_);
  } else {
    converted_.resize(packed_bytes(format, picture.width, picture.height));
    convert(picture, format, std::as_writable_bytes(std::span(converted_)).data());
  }
  return Picture::contiguous(format, picture.width, picture.height,
                             std::as_bytes(std::span(converted_)).data(),
                             row_bytes(format, picture.width));
}

/// The picture at the left, on black, and the text below it.
Picture VideoFrames::with_text(const Picture& picture, const ExportedPicture& exported) {
  canvas_.assign(packed_bytes(picture.format, width(), height()), 0);
  const auto canvas = MutablePicture::contiguous(picture.format, width(), height(),
                                                 std::as_writable_bytes(std::span(canvas_)).data(),
                                                 row_bytes(picture.format, width()));
  hal::recording::copy_pixels(
      picture, hal::recording::part_of(canvas, {0, 0, picture.width, picture.height}));
  caption_->draw(lines_of(exported),
                 hal::recording::part_of(canvas, {0, picture.height, width(), caption_->height()})
                     .samples<std::uint8_t>());
  return canvas;
}

}  // namespace orbwatch::app::recorder
