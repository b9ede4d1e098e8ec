#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "app/pipeline/view.h"
#include "app/pipeline/worker_pool.h"
#include "hal/camera.h"
#include "hal/frame_set.h"
#include "proc/optics/ball_projection.h"
#include "proc/optics/view_projection.h"
#include "proc/remap/colour_map.h"
#include "proc/remap/coordinate_grid.h"
#include "proc/remap/merged_remap.h"
#include "proc/remap/pyramid.h"

namespace orbwatch::app {

/// How the sources of a view are joined where several see a pixel.
enum class Combine {
  Mix,       ///< blended by weight wherever they see well
  Sharpest,  ///< blended by weight and resolution: the sharper camera dominates
  Switch,    ///< the first source that sees it and delivers
};

/// One camera as a view uses it.
struct ViewSource {
  std::size_t camera = 0;  ///< index into FrameSet::frames
  hal::StreamFormat format;
  optics::BallProjection ball;
  double weight = 1;            ///< above 0; in a mixed view, beside its resolution
  remap::ColourMap colour_map;  ///< for one-channel formats
};

/// A view, ready to be compiled.
struct ViewPlan {
  std::size_t index = 0;
  std::string name;
  optics::ViewProjection projection;
  std::vector<ViewSource> sources;  ///< 1..remap::kMaxSources
  Combine combine = Combine::Mix;
  remap::Interpolation interpolation = remap::Interpolation::Area;
  /// Which of `sources` is measured, raw; nothing for a view that is only looked at.
  std::optional<std::size_t> measured;
};

/// Turns frame sets into one view. Everything that depends on calibration or view is compiled when
/// it is made. Thread-bound: the pipeline's thread, which shares the work with the pool.
class ViewRenderer {
 public:
  /// Every source's format is_supported().
  explicit ViewRenderer(ViewPlan plan);

  static bool is_supported(PixelFormat format);

  /// A buffer of the view's size and planes, for the view's pool.
  View make_view() const;

  /// Fills `view` from the frames of `set`; a missing frame leaves its part blind.
  void render(const hal::FrameSet& set, View& view, WorkerPool& workers);

  const ViewPlan& plan() const { return plan_; }

 private:
  struct Source {
    remap::CoordinateGrid grid;
    remap::Pyramid pyramid;
  };

  void fill_pyramids(const hal::FrameSet& set, WorkerPool& workers);
  ImageView<std::uint8_t> plane(std::vector<std::uint8_t>& storage) const;
  std::vector<Source> make_sources() const;
  remap::BlendGrid make_blend() const;
  void compile_unseen();

  const remap::Kernel* kernel_;
  ViewPlan plan_;
  std::vector<Source> sources_;
  remap::BlendGrid blend_;
  std::vector<std::uint8_t> unseen_;  ///< per pixel the Validity when no camera delivers
};

}  // namespace orbwatch::app
