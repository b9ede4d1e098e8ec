// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "app/files/resolve.h"
#include "app/pipeline/pipeline.h"
#include "app/ports/lines/lines.h"
#include "app/simulation/machine.h"
#include "hal/camera.h"
#include "hal/fault.h"

namespace orbwatch::app::daemon {

/// Makes the camera that `settings` describe. Simulated ones look into `machine`.
std::unique_ptr<hal::Camera> make_camera(const files::CameraSettings& settings,
                                         const std::shared_ptr<const simulation::Machine>& machine);

/// Configures a camera of the site, with its controls and those of the first recipe. The fault:
/// Unplugged, as it is not there or cannot be opened; Refused, one of the controls; WrongFormat, it
/// delivers what the pipeline cannot use, or another size than the rig's.
hal::DeviceResult<hal::StreamFormat> open_camera(hal::Camera& camera, const files::Resolved& site,
                                                 std::size_t index);

/// The cameras of a site as they are at the start.
struct OpenedCameras {
  std::vector<std::unique_ptr<hal::Camera>> cameras;  ///< in the site's order
  std::vector<hal::StreamFormat> formats;  ///< what they deliver; the expected one of an absent one
  pipeline::CameraSet absent;              ///< those that could not be opened
};

/// Makes and opens the site's cameras; simulated ones look into `machine`.
OpenedCameras open_cameras(const files::Resolved& site,
                           const std::shared_ptr<const simulation::Machine>& machine);

/// Gives the pipeline its cameras, joined with their trigger `lines`, and its process inputs.
void add_cameras(pipeline::PipelinePlan& plan, OpenedCameras opened, const files::Resolved& site,
                 Lines& lines);

/// Opens an absent camera and has the pipeline take it up; compiles its views first where it
/// delivers another format than was expected. On the main thread. The error is also the camera's
/// fault.
hal::DeviceResult<> reconnect(const files::Resolved& site, std::size_t index, hal::Camera& camera,
                              pipeline::Pipeline& pipeline);

}  // namespace orbwatch::app::daemon
