// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "app/files/resolve.h"
#include "app/model/status/status.h"
#include "app/pipeline/measurement/compiled_recipe.h"
#include "app/pipeline/views/frame_pyramids.h"
#include "app/pipeline/views/view_buffers.h"
#include "app/pipeline/worker_pool.h"
#include "hal/camera.h"
#include "hal/sync/frame_set.h"
#include "proc/image/result.h"

namespace orbwatch::app::daemon {

/// Measures frame sets as the pipeline does, one after another, without cameras and sinks.
/// Thread-bound.
class SetMeter {
 public:
  /// `formats`: by camera; `threads`: workers beside the calling thread. Errors: those of
  /// SitePlan::make() and CompiledRecipe::make().
  static Result<SetMeter> make(const files::Resolved& site, std::vector<hal::StreamFormat> formats,
                               std::size_t threads);

  /// Regions and alarms of the set, by the recipe of that number, until the next call.
  /// `process_active`: for recipes that do not detect it; `now`: for the delays of alarms. Error:
  /// there is no such recipe.
  Result<const Status*> measure(const hal::FrameSet& set, std::uint16_t recipe, bool process_active,
                                hal::TimePoint now);

 private:
  SetMeter(std::vector<std::unique_ptr<pipeline::CompiledRecipe>> recipes,
           const std::vector<hal::StreamFormat>& formats, std::size_t threads);

  std::vector<std::unique_ptr<pipeline::CompiledRecipe>> recipes_;
  std::unique_ptr<pipeline::ViewBuffers> buffers_;
  pipeline::FramePyramids pyramids_;
  std::unique_ptr<pipeline::WorkerPool> workers_;
  std::unique_ptr<Status> status_;
  pipeline::CompiledRecipe* recipe_ = nullptr;  ///< measured last
};

}  // namespace orbwatch::app::daemon
