// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <deque>
#include <optional>
#include <string_view>
#include <vector>

#include "proc/remap/merge/merged_remap.h"
#include "tests/bench/frame.h"

namespace orbwatch::bench {

/// A view that the product merges from cameras.
struct MergedCase {
  std::string_view name;
  bool panorama;                       ///< false: 1920x1080, 90 degrees wide
  std::array<PixelFormat, 3> sources;  ///< the first `count` are used
  std::size_t count;
  bool measured;  ///< true if the last source is measured
};

/// The cases of the instruction counts. With two sources, both see all of the view and have equal
/// shares; the three of a panorama are 120 degrees apart, so that it includes limbs and blind
/// cones.
inline constexpr std::array kMergedCases{
    MergedCase{"nv12", false, {PixelFormat::Nv12}, 1, false},
    MergedCase{"yuyv", false, {PixelFormat::Yuyv}, 1, false},
    MergedCase{"rgb", false, {PixelFormat::Rgb}, 1, false},
    MergedCase{"nv12_measured", false, {PixelFormat::Nv12}, 1, true},
    MergedCase{"rgb_measured", false, {PixelFormat::Rgb}, 1, true},
    MergedCase{"nv12_y16", false, {PixelFormat::Nv12, PixelFormat::Y16}, 2, true},
    MergedCase{"rgb_y16", false, {PixelFormat::Rgb, PixelFormat::Y16}, 2, true},
    MergedCase{"grey_y16", false, {PixelFormat::Grey, PixelFormat::Y16}, 2, true},
    MergedCase{"panorama", true, {PixelFormat::Nv12, PixelFormat::Nv12, PixelFormat::Y16}, 3, true},
    MergedCase{
        "panorama_grey", true, {PixelFormat::Grey, PixelFormat::Grey, PixelFormat::Y16}, 3, true},
};

/// One camera of a merged view.
struct MergedCamera {
  /// Makes a camera that shows waves.
  MergedCamera(PixelFormat format, const optics::ViewProjection& view, double yaw, unsigned seed);

  Frame frame;
  Picture picture;
  optics::BallProjection ball;
  remap::CoordinateGrid grid;
};

/// Colours, and the counts of the first and the last of them.
struct ColourScale {
  remap::ColourMap::Table table;
  double low;
  double high;
};

/// The scale of a one-channel camera.
ColourScale scale_of(PixelFormat format);

/// One case with waves in all cameras: colour ones of 1920x1080, thermal ones of 640x512.
class MergedView {
 public:
  explicit MergedView(const MergedCase& wanted,
                      const remap::Kernel& kernel = remap::default_kernel());

  void run();

  const optics::ViewProjection& view() const { return view_; }
  const std::deque<MergedCamera>& cameras() const { return cameras_; }
  const remap::BlendGrid& blend() const { return *blend_; }

  // Results of run().
  const Frame& output() const { return out_; }
  const std::optional<Frame>& measured() const { return measured_; }

 private:
  const remap::Kernel& kernel_;
  optics::ViewProjection view_;
  std::deque<MergedCamera> cameras_;
  std::deque<remap::ColourMap> colours_;  ///< one per camera
  std::optional<remap::BlendGrid> blend_;
  std::optional<Frame> measured_;
  Frame out_;
  Frame unseen_;
  Frame validity_;
  std::vector<remap::MergedSource> sources_;
};

}  // namespace orbwatch::bench
