// SPDX-License-Identifier: Apache-2.0
#include "app/watch/outline_watch.h"

#include <cstdio>
#include <utility>

#include "app/log.h"
#include "app/watch/kept_zero.h"

namespace orbwatch::app {

OutlineWatch::OutlineWatch(std::string name, std::shared_ptr<hal::SharedThreads> threads)
    : name_(std::move(name)), work_(std::move(threads), [this] { compare(); }) {}

void OutlineWatch::check(OutlineSubject subject) {
  {
    const std::lock_guard lock(mutex_);
    subject_ = std::move(subject);
  }
  work_.request();
}

void OutlineWatch::report(CameraWatchStatus& figures) const {
  const std::lock_guard lock(mutex_);
  figures.outline_check = checked_.state;
  figures.outline_offset = checked_.offset_percent;
  figures.outline_offset_px = checked_.offset_px;
}

void OutlineWatch::compare() {
  std::optional<OutlineSubject> subject;
  {
    const std::lock_guard lock(mutex_);
    subject = std::exchange(subject_, std::nullopt);
  }
  if (!subject) return;
  const OutlineCheck seen =
      check_outline(luminance_picture(subject->luminance, subject->format), subject->stated);
  log(seen);
  const std::lock_guard lock(mutex_);
  checked_ = seen;
}

void OutlineWatch::log(const OutlineCheck& check) const {
  if (check.state == OutlineState::Unknown) {
    log_camera(LogLevel::Info, name_, "its stated outline is not checked: " + check.doubt);
  }
  if (check.state != OutlineState::NotAligned) return;
  char offset[64];
  std::snprintf(offset, sizeof offset, "%.1f px, %.1f %% of the radius", check.offset_px,
                check.offset_percent);
  log_camera(LogLevel::Warning, name_,
             "its stated outline is " + std::string(operator_text(check.state)) + ": off by " +
                 offset + "; align it (`orbwatch detect`, or the command detect_ball)");
}

}  // namespace orbwatch::app
