#include "app/dds/rate_limit.h"

#include <utility>

namespace orbwatch::app {

std::optional<std::uint64_t> RateLimit::admit(hal::TimePoint now) {
  if (!start_ || now - *start_ >= period_) {
    start_ = now;
    used_ = 0;
  }
  if (used_ >= limit_) {
    ++withheld_;
    return std::nullopt;
  }
  ++used_;
  return std::exchange(withheld_, 0);
}

}  // namespace orbwatch::app
