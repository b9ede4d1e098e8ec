// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "app/files/camera_settings.h"
#include "proc/image/result.h"

namespace orbwatch::app::cli {

/// Source of a camera's pictures, and its name, if that is known.
struct CameraSource {
  std::string name;
  files::BackEndSettings back_end;
};

/// `word` as [NAME=]SOURCE: a folder of pictures, a picture or a video, which are replayed; a V4L2
/// device or its place on a bus; a camera of libcamera by its id, one of genicam by
/// any of its names. Error: none of these.
Result<CameraSource> camera_source(const std::string& word);

/// Every camera that is connected, without names. Those of libcamera that V4L2 shows, too, are
/// there once. Error: none is.
Result<std::vector<CameraSource>> connected_cameras();

/// The lines of a site file that state the back-end of a camera.
std::string back_end_text(const files::BackEndSettings& back_end);

}  // namespace orbwatch::app::cli
