#include "app/daemon/attempts.h"

#include <algorithm>
#include <utility>

#include "app/log.h"

namespace orbwatch::app {

void Attempts::add(std::string name, Attempt attempt, hal::TimePoint now) {
  Missing missing{std::move(name), std::move(attempt), {}, now, {}};
  if (!succeeds(missing, now)) missing_.push_back(std::move(missing));
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
    if (!missing.error.empty()) log_line(LogLevel::Info, missing.name + ": is there");
    return true;
  }
  missing.due = now + missing.pause.next();
  if (std::exchange(missing.error, done.error().message) != done.error().message) {
    log_line(LogLevel::Warning, missing.error + "; tries again");
  }
  return false;
}

}  // namespace orbwatch::app
