#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "app/model/view.h"
#include "app/pipeline/views/frame_pyramids.h"
#include "app/pipeline/views/view_plan.h"
#include "app/pipeline/worker_pool.h"
#include "hal/sync/frame_set.h"
#include "proc/remap/remap.h"

namespace orbwatch::app {

/// A buffer of the view's size and planes, whose name is the plan's own.
View make_view(const ViewPlan& plan);

/// Where a view's pixels go; each of the view's size.
struct RenderTarget {
  MutablePicture picture;  ///< Rgb, or the one format of all sources: Grey, Y16, Rgb or Rgb16
  ImageView<std::uint8_t> validity;  ///< one Validity per pixel
  /// Where the measured source goes, raw, beside an Rgb picture: its luminance as Grey, or its
  /// counts in its own 16 bit format. No data: nowhere.
  MutablePicture measured;
};

/// Turns frame sets into one view. Everything that depends on calibration or view is compiled when
/// it is made. Thread-bound; shares the work with a pool.
class ViewRenderer {
 public:
  /// Every source's format is_supported(), unless only a target of the sources' format is rendered
  /// to.
  explicit ViewRenderer(ViewPlan plan);

  static bool is_supported(PixelFormat format);

  /// Raises `counts` to the mip levels that this view samples.
  void require_levels(MipLevelCounts& counts) const;

  /// Fills `view` from the frames of `set`, of which `pyramids` were built; a missing frame leaves
  /// its part blind. Does not allocate.
  void render(const hal::FrameSet& set, const FramePyramids& pyramids, View& view,
              WorkerPool& workers) const;
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
  int levels(std::size_t source) const;
  std::span<const Picture> pictures_of(std::size_t source, const FramePyramids& pyramids) const;
  template <class T>
  std::vector<remap::PhotometricMatch> compare_sources(const FramePyramids& pyramids) const;

  const remap::Kernel* kernel_;
  ViewPlan plan_;
  std::vector<remap::CoordinateGrid> grids_;  ///< by source
  remap::BlendGrid blend_;
  std::vector<std::uint8_t> unseen_;  ///< per pixel the Validity when no camera delivers
  std::vector<remap::PhotometricTable> matches_;  ///< by source; empty: all as they are
};

}  // namespace orbwatch::app
