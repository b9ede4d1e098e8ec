// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "app/model/sink/view.h"
#include "app/pipeline/views/frame_pyramids.h"
#include "app/pipeline/views/view_colours.h"
#include "app/pipeline/views/view_plan.h"
#include "app/pipeline/worker_pool.h"
#include "hal/sync/frame_set.h"
#include "proc/remap/remap.h"

namespace orbwatch::app::pipeline {

/// Targets of a view's pixels; each has the view's size.
struct RenderTarget {
  /// Rgb, Bgr, Grey; or raw, the one format of all sources: Grey, Y16, Rgb or Rgb16. No data: none.
  MutablePicture picture;
  ImageView<std::uint8_t> validity;  ///< one Validity per pixel
  /// Target of the raw plane's source beside the picture: its luminance as Grey, or its counts in
  /// its own 16 bit format. No data: none.
  MutablePicture measured;
  bool is_raw = false;  ///< the picture: one-channel sources are not colour-mapped
  ChosenColours colours{};
  bool is_measured_before = false;  ///< an earlier call wrote `measured`; it is only read
};

/// Turns frame sets into one view. Everything that depends on calibration or view is compiled when
/// it is made. Thread-bound; shares the work with a pool.
class ViewRenderer {
 public:
  /// Every source's format is_supported(), unless only a target of the sources' format is rendered
  /// to.
  explicit ViewRenderer(ViewPlan plan);

  static bool is_supported(PixelFormat format);

  /// Adds what this view samples for its measured plane, and for its picture.
  void add_measured_use(PictureUses& uses) const;
  void add_use(PictureUses& uses) const;

  /// True if its sources count temperature: then render() fills View::counts, too.
  bool has_counts() const { return raw_ && counts_temperature(plan_.sources[*raw_]); }

  /// Fills `view`, its picture in the format that it has, from the frames of `set`, of which
  /// `pyramids` were built with add_use(); a missing frame leaves its part blind. Does not
  /// allocate.
  void render(const hal::FrameSet& set, const FramePyramids& pyramids, View& view,
              WorkerPool& workers, ChosenColours colours = {}) const;
  /// Fills the measured plane and the validity of `view` alone, from `pyramids` that were built
  /// with add_measured_use(): figures do not wait for the picture.
  void measure(const hal::FrameSet& set, const FramePyramids& pyramids, View& view,
               WorkerPool& workers) const;
  /// Fills the picture of a view that measure() filled, in the format that it has.
  void draw(const FramePyramids& pyramids, View& view, WorkerPool& workers,
            ChosenColours colours = {}) const;
  /// The same without a View.
  void render(const FramePyramids& pyramids, const RenderTarget& target, WorkerPool& workers) const;

  /// Compares the sources' pictures, all there and of one format of a RenderTarget, where several
  /// see the same, and renders to targets of that format with the first one's exposure from now on.
  /// Returns one match per source. Allocates; not for the frame path.
  std::vector<remap::PhotometricMatch> match_photometry(const FramePyramids& pyramids);

  const ViewPlan& plan() const { return plan_; }

 private:
  std::vector<remap::CoordinateGrid> make_grids() const;
  remap::BlendGrid make_blend() const;
  std::vector<std::uint8_t> make_unseen() const;
  std::vector<remap::SourceArea> find_sharpened() const;
  void describe(const hal::FrameSet& set, View& view) const;
  void describe_colours(View& view, ChosenColours colours) const;
  MutablePicture measured_plane(View& view) const;
  int levels(std::size_t source) const;
  double sharpness(std::size_t source) const;
  std::span<const Picture> pictures_of(std::size_t source, const FramePyramids& pyramids,
                                       double sharpness) const;
  template <class T>
  std::vector<remap::PhotometricMatch> compare_sources(const FramePyramids& pyramids) const;

  const remap::Kernel* kernel_;
  ViewPlan plan_;
  std::optional<std::size_t> raw_;            ///< see ViewPlan::raw()
  std::vector<remap::CoordinateGrid> grids_;  ///< by source
  remap::BlendGrid blend_;
  std::vector<remap::SourceArea> sharpened_;  ///< by source, what of it is sampled sharpened
  std::vector<std::uint8_t> unseen_;          ///< per pixel the Validity when no camera delivers
  bool is_matched_;                           ///< by what the pyramids have
  std::vector<remap::PhotometricTable> matches_;  ///< by source, in place of that
};

}  // namespace orbwatch::app::pipeline
