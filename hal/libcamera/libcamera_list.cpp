// SPDX-License-Identifier: Apache-2.0
#include "hal/libcamera/libcamera_list.h"

#include <libcamera/camera.h>
#include <libcamera/logging.h>

#include "hal/libcamera/camera_manager.h"
#include "hal/libcamera/controls/libcamera_controls.h"

namespace orbwatch::hal {
namespace {

std::string to_text(const libcamera::SizeRange& sizes) {
  return sizes.min == sizes.max ? sizes.min.toString()
                                : sizes.min.toString() + ".." + sizes.max.toString();
}

CameraEntry entry_of(libcamera::Camera& camera) {
  CameraEntry entry;
  entry.id = camera.id();
  entry.back_end = "libcamera";
  entry.model = model_of(camera);
  entry.controls = list_controls(camera.controls());
  const auto offered = camera.generateConfiguration({libcamera::StreamRole::VideoRecording});
  if (!offered || offered->empty()) {
    entry.problem = "has no stream for video";
    return entry;
  }
  const libcamera::StreamFormats& formats = offered->at(0).formats();
  for (const libcamera::PixelFormat& format : formats.pixelformats()) {
    entry.modes.push_back({format.toString(), to_text(formats.range(format)), {}});
  }
  return entry;
}

}  // namespace

std::vector<CameraEntry> list_libcamera_cameras() {
  libcamera::logSetTarget(libcamera::LoggingTargetNone);
  const auto manager = camera_manager();
  if (!manager) {
    CameraEntry none;
    none.back_end = "libcamera";
    none.problem = manager.error().message;
    return {none};
  }
  std::vector<CameraEntry> entries;
  for (const auto& camera : (*manager)->cameras()) entries.push_back(entry_of(*camera));
  return entries;
}

}  // namespace orbwatch::hal
