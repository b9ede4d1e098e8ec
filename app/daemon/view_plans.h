#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "app/config/configuration.h"
#include "app/pipeline/view_renderer.h"
#include "hal/camera.h"

namespace orbwatch::app {

/// The file's numbers (degC for a radiometric camera, else percent of full scale) as the camera's
/// counts.
double counts(double value, const CameraSettings& camera, const hal::StreamFormat& format);

/// Plans a view that the configuration has checked. `index`: among all views. `formats`: by camera.
/// `measured`: name of the camera that is measured, empty for a view to look at. Error: the rig
/// makes it impossible; the message names the view.
Result<ViewPlan> plan_view(const Configuration& configuration, const ViewSettings& view,
                           std::size_t index, const std::vector<hal::StreamFormat>& formats,
                           const std::string& measured = {});

}  // namespace orbwatch::app
