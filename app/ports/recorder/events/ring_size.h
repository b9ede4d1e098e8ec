// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "app/model/sink/recorded_camera.h"
#include "app/ports/recorder/events/event_settings.h"
#include "proc/image/result.h"

namespace orbwatch::app::recorder {

/// True: the settings name the camera, or none. Reentrant.
bool is_recorded(const EventSettings& settings, std::string_view camera);

/// Bytes of the camera's part of a picture; of JPEG data that the camera sends a quarter of the
/// whole picture's, which USB cameras stay below. Reentrant.
std::size_t picture_bytes_of(const RecordedCamera& camera);

/// Checks that the ring holds a whole event with one trigger, as far as rates and formats are
/// known. Errors: a camera that does not exist, or whose pictures are too large for a recording;
/// what the ring must have. Reentrant.
Result<> check_ring(const EventSettings& settings, const std::vector<RecordedCamera>& cameras);

}  // namespace orbwatch::app::recorder
