// SPDX-License-Identifier: Apache-2.0
#include "app/daemon/process/attempts.h"

#include <algorithm>
#include <utility>

#include "app/log.h"

namespace orbwatch::app::daemon {

void Attempts::add(std::string name, Attempt attempt, hal::TimePoint now) {
  const auto without_fault = [attempt = std::move(attempt)] {
    return attempt().map_error([](Error error) {
      return hal::FaultReport{hal::Fault::None, std::move(error.message)};
    });
  };
  add({std::move(name), {}, without_fault, {}, now, {}});
}

void Attempts::add_camera(std::string camera, CameraAttempt attempt, hal::TimePoint now) {
  std::string name = "camera " + camera;
  add({std::move(name), std::move(camera), std::move(attempt), {}, now, {}});
}

void Attempts::add(Missing missing) {
  if (!succeeds(missing, missing.due)) missing_.push_back(std::move(missing));
}

hal::TimePoint Attempts::due() const {
  hal::TimePoint next = hal::TimePoint::max();
  for (const Missing& missing : missing_) next = std::min(next, missing.due);
  return next;
}

void Attempts::run(hal::TimePoint now) {
  missing_.remove_if(
      [now](Missing& missing) { return missing.due <= now && succeeds(missing, now); });
}

bool Attempts::succeeds(Missing& missing, hal::TimePoint now) {
  const auto done = missing.attempt();
  if (done) {
    if (!missing.error.detail.empty()) {
      log_line(LogLevel::Info, missing.name + ": is there",
               {.camera = missing.camera, .fault = hal::word(missing.error.fault)});
    }
    return true;
  }
  missing.due = now + missing.pause.next();
  const hal::FaultReport before = std::exchange(missing.error, done.error());
  if (before.detail != missing.error.detail) {
    log_line(LogLevel::Warning, missing.error.detail + "; tries again",
             {.camera = missing.camera, .fault = hal::word(missing.error.fault)});
  }
  return false;
}

}  // namespace orbwatch::app::daemon
