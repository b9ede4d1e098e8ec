#include "proc/signals/hot_spot/blob_pixels.h"

namespace orbwatch::signals {

BlobPixels::BlobPixels(const RegionMask& mask)
    : left_(mask.left()),
      right_(mask.right()),
      top_(mask.top()),
      bottom_(mask.bottom()),
      stride_(static_cast<std::size_t>(mask.right() - mask.left()) + 2),
      state_(stride_ * (static_cast<std::size_t>(mask.bottom() - mask.top()) + 2)) {
  for (const Span& span : mask.spans()) {
    for (int x = span.begin; x < span.end; ++x) state_[index(x, span.y)] = kInRegion;
  }
  spans_.reserve(mask.most_runs());
}

void BlobPixels::assign(const LevelSet& level, std::size_t blob) {
  clear();
  for (const Run& run : level.runs()) {
    if (run.blob == blob) add(run.span);
  }
}

void BlobPixels::assign(const BlobPixels& other) {
  clear();
  for (const Span& span : other.spans_) add(span);
}

void BlobPixels::add(const Span& span) {
  first_x_ = spans_.empty() ? span.begin : std::min(first_x_, span.begin);
  last_x_ = spans_.empty() ? span.end - 1 : std::max(last_x_, span.end - 1);
  spans_.push_back(span);
  mark(span, true);
}

void BlobPixels::clear() {
  for (const Span& span : spans_) mark(span, false);
  spans_.clear();
}

void BlobPixels::mark(const Span& span, bool member) {
  const auto state = static_cast<std::uint8_t>(member ? kInRegion | kMember : kInRegion);
  std::fill_n(&state_[index(span.begin, span.y)], span.end - span.begin, state);
}

}  // namespace orbwatch::signals
