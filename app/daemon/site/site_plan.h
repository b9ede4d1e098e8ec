// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "app/files/resolve.h"
#include "app/pipeline/measurement/recipe_plan.h"
#include "app/pipeline/views/view_plan.h"
#include "hal/camera.h"
#include "proc/image/result.h"
#include "proc/optics/view_projection.h"
#include "proc/signals/region.h"

namespace orbwatch::app::daemon {

/// The format of a camera that is not open yet, as far as the files state it; limits in percent fit
/// any depth. Reentrant.
hal::StreamFormat expected_format(const files::Resolved& site, std::size_t camera);

/// The same by camera.
std::vector<hal::StreamFormat> expected_formats(const files::Resolved& site);

/// Views and recipes of a site as objects, for cameras of given formats. It is made once, and read
/// by the pipeline, the interfaces and the checks. No view is compiled and no picture allocated.
struct SitePlan {
  signals::RegionScene scene;              ///< the ball and the surfaces around it
  std::vector<hal::StreamFormat> formats;  ///< by camera
  std::vector<pipeline::ViewPlan> views;   ///< display views, by index
  /// In the order of `views`: the room as a view of kind Ball shows it, from the ball's centre;
  /// null for other kinds.
  std::vector<std::shared_ptr<const optics::ViewProjection>> balls;
  std::vector<pipeline::RecipePlan> recipes;  ///< by place in Resolved::recipes

  /// Errors: the scene; what keeps files from running together although each is right by itself,
  /// with the name of the view, or of the recipe's file and the region. Reentrant.
  static Result<SitePlan> make(const files::Resolved& site, std::vector<hal::StreamFormat> formats);
};

/// True: a display view that shows the ball as one camera alone sees it.
inline bool is_own_picture(const pipeline::ViewSettings& view) {
  return view.kind == optics::ViewKind::Ball && view.sources.size() == 1;
}

/// Names the file of the recipe at that place in front of an error.
Error in_recipe(const files::Resolved& site, std::size_t recipe, const Error& error);

}  // namespace orbwatch::app::daemon
