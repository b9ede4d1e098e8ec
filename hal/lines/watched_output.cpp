// SPDX-License-Identifier: Apache-2.0
#include "hal/lines/watched_output.h"

#include <utility>

namespace orbwatch::hal {

WatchedOutput::WatchedOutput(LineBackEnd& back_end, OutputSettings settings,
                             LineRetry::OnFault on_fault, TimePoint now)
    : back_end_(back_end), settings_(std::move(settings)), retry_(std::move(on_fault)) {
  open(now);
}

LineResult<> WatchedOutput::set(bool active) {
  active_ = active;
  if (!output_) return tl::unexpected(LineFaultReport{LineFault::Gone, {}});
  auto done = output_->set(active);
  if (!done) check_ = TimePoint::min();
  return done;
}

void WatchedOutput::run(TimePoint now) {
  if (now < due()) return;
  if (!output_) return open(now);
  check_ = now + kLineCheckPeriod;
  if (const auto works = output_->set(active_); !works) {
    output_.reset();
    retry_.failed(works.error(), now);
  }
}

void WatchedOutput::open(TimePoint now) {
  auto opened = back_end_.open_output(settings_);
  if (!opened) return retry_.refused(opened.error(), now);
  output_ = std::move(*opened);
  retry_.works();
  check_ = now;  // run() sets its level
}

}  // namespace orbwatch::hal
