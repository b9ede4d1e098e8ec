#include "proc/optics/alhazen.h"

#include <algorithm>

namespace orbwatch::optics {

// One thought per loop, and no branch in it: compilers make vector code of that.
void bisector_offsets(const HalfAngleLanes& h, const Lanes& p, double q, OffsetLanes& out) {
  OffsetLanes series, better;
  Lanes enough, settled;
  for (std::size_t k = 0; k < kLanes; ++k) {
    Bisector bisector(h.at(k), p[k], q);
    enough[k] = bisector.start() ? 1 : 0;
    series.set(k, bisector.offset());
  }
  if (std::all_of(enough.begin(), enough.end(), [](double yes) { return yes != 0; })) {
    out = series;
    return;
  }
  for (std::size_t k = 0; k < kLanes; ++k) {
    Bisector bisector(h.at(k), p[k], q, series.at(k));
    settled[k] = bisector.improve() ? 1 : 0;
    better.set(k, bisector.offset());
  }
  for (std::size_t k = 0; k < kLanes; ++k) {
    const Offset first = series.at(k), second = better.at(k);
    out.set(k, enough[k] != 0 ? first : second);
  }
  for (std::size_t k = 0; k < kLanes; ++k) {
    if (enough[k] == 0 && settled[k] == 0) out.set(k, bisector_offset(h.at(k), p[k], q));
  }
}

}  // namespace orbwatch::optics
