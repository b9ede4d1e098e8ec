// SPDX-License-Identifier: Apache-2.0
#include "app/ports/recorder/events/frame_ring.h"

#include <algorithm>
#include <mutex>

#include "proc/image/pixel_format.h"

namespace orbwatch::app::recorder {
namespace {

std::size_t bytes_of(const KeptFrame& frame) {
  if (!frame.jpeg.empty()) return frame.jpeg.size();
  const Picture& picture = frame.picture;
  const int row = row_bytes(picture.format, picture.width);
  return picture_bytes(picture.format, static_cast<std::size_t>(row), picture.height);
}

/// Copies the picture or its JPEG data to `place`. Returns the frame with the copy.
KeptFrame copy_to(std::byte* place, const KeptFrame& frame) {
  KeptFrame kept = frame;
  const Picture& picture = frame.picture;
  if (!frame.jpeg.empty()) {
    std::ranges::copy(frame.jpeg, place);
    kept.jpeg = {place, frame.jpeg.size()};
    kept.picture.planes = {};
    return kept;
  }
  MutablePicture copy = MutablePicture::contiguous(picture.format, picture.width, picture.height,
                                                   place, row_bytes(picture.format, picture.width));
  copy.colour_space = picture.colour_space;
  hal::recording::copy_pixels(picture, copy);
  kept.picture = copy;
  return kept;
}

/// Pictures begin at multiples of it, so that their samples are aligned.
constexpr std::size_t kAlignment = 64;

}  // namespace

FrameRing::FrameRing(std::size_t bytes, std::size_t least_frame)
    : bytes_(bytes), slots_(bytes / std::max(least_frame, kAlignment) + 1) {}

/// True: a window needs the picture and has not read it.
bool FrameRing::is_held(std::uint64_t number) const {
  const hal::TimePoint stamp = slot(number).frame.set_stamp;
  return std::ranges::any_of(
      windows_, [&](const Held& window) { return window.needs(stamp) && number >= window.next; });
}

/// Frees room behind the newest picture. Places count bytes since start, so that the ring is
/// bytes_.size() of them from the oldest picture on; a picture does not wrap around.
std::optional<std::uint64_t> FrameRing::place_for(std::size_t bytes) {
  const std::uint64_t size = bytes_.size();
  if (bytes > size) return std::nullopt;
  std::uint64_t begin = behind_ == 0 ? 0 : slot(behind_ - 1).end;
  begin = (begin + kAlignment - 1) / kAlignment * kAlignment;
  if (begin % size + bytes > size) begin += size - begin % size;
  while (oldest_ != behind_) {
    const bool has_slot = behind_ - oldest_ < slots_.size();
    if (has_slot && begin + bytes <= slot(oldest_).begin + size) break;
    if (is_held(oldest_)) return std::nullopt;
    missing_ = std::max(missing_, slot(oldest_++).frame.set_stamp);
  }
  return begin;
}

/// Counts a picture that found no room, also for each window that lacks it.
void FrameRing::lose(hal::TimePoint stamp) {
  missing_ = stamp;
  ++lost_;
  for (Held& window : windows_) window.lost += window.needs(stamp) ? 1 : 0;
}

bool FrameRing::put(const KeptFrame& frame) {
  const std::size_t bytes = bytes_of(frame);
  std::optional<std::uint64_t> begin;
  {
    const std::lock_guard lock(mutex_);
    begin = place_for(bytes);
    if (!begin) {
      lose(frame.set_stamp);
      return false;
    }
  }
  const KeptFrame kept = copy_to(bytes_.data() + *begin % bytes_.size(), frame);
  const std::lock_guard lock(mutex_);
  slot(behind_++) = {kept, *begin, *begin + bytes};
  return true;
}

std::optional<FrameRing::Window> FrameRing::hold(hal::TimePoint first, hal::TimePoint last) {
  const std::lock_guard lock(mutex_);
  const auto free = std::ranges::find_if(
      windows_, [](const Held& window) { return !window.is_read && window.is_closed; });
  if (free == windows_.end()) return std::nullopt;
  std::uint64_t next = oldest_;
  while (next != behind_ && slot(next).frame.set_stamp < first) ++next;
  *free = {.is_read = true, .is_closed = false, .first = first, .last = last, .next = next};
  return Window{static_cast<std::size_t>(free - windows_.begin()), missing_ < first};
}

bool FrameRing::extend(std::size_t window, hal::TimePoint last) {
  const std::lock_guard lock(mutex_);
  Held& held = windows_[window];
  held.last = std::max(held.last, last);
  return held.is_read;
}

void FrameRing::close(std::size_t window) {
  const std::lock_guard lock(mutex_);
  windows_[window].is_closed = true;
}

/// The picture that the window reads next; null: none at present. One behind the window's end is
/// not held, and may be replaced.
const FrameRing::Slot* FrameRing::next_of(const Held& window) const {
  const bool is_there = window.next >= oldest_ && window.next < behind_;
  if (!is_there || slot(window.next).frame.set_stamp > window.last) return nullptr;
  return &slot(window.next);
}

std::optional<KeptFrame> FrameRing::next(std::size_t window) const {
  const std::lock_guard lock(mutex_);
  const Slot* const next = next_of(windows_[window]);
  return next ? std::optional(next->frame) : std::nullopt;
}

void FrameRing::pass(std::size_t window) {
  const std::lock_guard lock(mutex_);
  ++windows_[window].next;
}

hal::TimePoint FrameRing::last_of(std::size_t window) const {
  const std::lock_guard lock(mutex_);
  return windows_[window].last;
}

std::uint64_t FrameRing::lost_of(std::size_t window) const {
  const std::lock_guard lock(mutex_);
  return windows_[window].lost;
}

bool FrameRing::is_over(std::size_t window) const {
  const std::lock_guard lock(mutex_);
  return windows_[window].is_closed && !next_of(windows_[window]);
}

void FrameRing::release(std::size_t window) {
  const std::lock_guard lock(mutex_);
  windows_[window].is_read = false;
}

RingUse FrameRing::use() const {
  const std::lock_guard lock(mutex_);
  if (oldest_ == behind_) return {0, {}, lost_};
  const Slot& first = slot(oldest_);
  const Slot& last = slot(behind_ - 1);
  return {static_cast<std::size_t>(last.end - first.begin),
          last.frame.set_stamp - first.frame.set_stamp, lost_};
}

}  // namespace orbwatch::app::recorder
