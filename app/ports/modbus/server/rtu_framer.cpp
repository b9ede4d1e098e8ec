// SPDX-License-Identifier: Apache-2.0
#include "app/ports/modbus/server/rtu_framer.h"

#include <algorithm>
#include <utility>

#include "app/ports/modbus/server/request.h"

namespace orbwatch::app::modbus {
namespace {

constexpr std::size_t kUnit = 1;
constexpr std::size_t kChecksum = 2;
constexpr std::size_t kShortestFrame = kUnit + 1 + kChecksum;

/// The checksum (V1.02, 6.2.2) over one more byte.
std::uint16_t checked(std::uint16_t checksum, std::uint8_t byte) {
  checksum ^= byte;
  for (int bit = 0; bit < 8; ++bit) {
    checksum = static_cast<std::uint16_t>(checksum & 1 ? checksum >> 1 ^ 0xa001 : checksum >> 1);
  }
  return checksum;
}

/// Length of the shortest prefix that ends with its own checksum and therefore has the checksum 0;
/// returns 0 if there is none.
std::size_t checked_length(std::span<const std::uint8_t> bytes) {
  std::uint16_t checksum = 0xffff;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    checksum = checked(checksum, bytes[i]);
    if (checksum == 0 && i + 1 >= kShortestFrame) return i + 1;
  }
  return 0;
}

bool is_checked(std::span<const std::uint8_t> frame) {
  std::uint16_t checksum = 0xffff;
  for (const std::uint8_t byte : frame) checksum = checked(checksum, byte);
  return checksum == 0;
}

}  // namespace

void RtuFramer::push(std::span<const std::uint8_t> bytes, hal::Clock::duration silence) {
  if (silence >= pause_) {
    is_lost_ = false;
    const std::size_t begun = this->bytes().size();
    const bool may_go_on = begun > 0 && is_for_us(this->bytes()[0]) && silence < kMaxGap;
    if (begun > 0 && !may_go_on) {
      ++errors_;
      spoil(begun);
    }
    if (silence >= kMaxGap) drop(0);
    after_pause_ = this->bytes().size();
  }
  std::ranges::copy(bytes, buffer_.begin() + static_cast<std::ptrdiff_t>(size_));
  size_ += bytes.size();
  if (is_lost_) spoil(bytes.size());
}

std::optional<std::span<const std::uint8_t>> RtuFramer::next() {
  if (returned_ > 0) drop(std::exchange(returned_, 0));
  while (!bytes().empty()) {
    const auto length = frame_length(bytes());
    // The bytes before the pause may be noise.
    const bool is_noise =
        !length || (*length == 0 && frame_length(bytes().subspan(after_pause_)).value_or(0) > 0);
    if (is_noise) {
      resynchronise();
    } else if (*length == 0) {
      return std::nullopt;
    } else if (is_for_us(bytes()[0])) {
      returned_ = *length;
      return bytes().first(returned_);
    } else {
      ++other_units_;
      drop(*length);
    }
  }
  return std::nullopt;
}

void RtuFramer::end() {
  const auto request = last_request();
  // Spoilt bytes are counted already.
  const bool is_whole = request && request->data() <= bytes().data();
  if (!bytes().empty() && !is_whole) ++errors_;
  size_ = request ? request->size() : 0;
  if (request) std::ranges::copy(*request, buffer_.begin());
  spoilt_ = after_pause_ = 0;
  is_lost_ = false;
}

/// The request at the end of the bytes, or before one stray byte. The longest frame wins, because a
/// shorter one at its end would be a part of it. So a part of a request for another unit is not
/// answered either.
std::optional<std::span<const std::uint8_t>> RtuFramer::last_request() const {
  const auto all = std::span(buffer_).first(size_);
  for (std::size_t stray = 0; stray <= 1 && stray < all.size(); ++stray) {
    const auto sent = all.first(all.size() - stray);
    const std::size_t longest = std::min(sent.size(), kLongestFrame);
    for (std::size_t length = longest; length >= kShortestFrame; --length) {
      const auto frame = sent.last(length);
      if (!is_checked(frame)) continue;
      if (!is_for_us(frame[0])) return std::nullopt;
      if (frame_length(frame) == length) return frame;
    }
  }
  return std::nullopt;
}

/// Length of the frame at the beginning of these bytes; 0: incomplete; nullopt: not a frame.
std::optional<std::size_t> RtuFramer::frame_length(std::span<const std::uint8_t> bytes) const {
  const bool has_function = bytes.size() > kUnit;
  if (const auto pdu = has_function && is_for_us(bytes[0]) ? request_length(bytes.subspan(kUnit))
                                                           : std::nullopt) {
    const std::size_t length = kUnit + *pdu + kChecksum;
    if (length > kLongestFrame) return std::nullopt;
    if (bytes.size() < length) return 0;
    return is_checked(bytes.first(length)) ? std::optional(length) : std::nullopt;
  }
  const std::size_t length = checked_length(bytes.first(std::min(bytes.size(), kLongestFrame)));
  return length == 0 && bytes.size() >= kLongestFrame ? std::nullopt : std::optional(length);
}

/// Continues after the last pause, or without one after the next pause.
void RtuFramer::resynchronise() {
  ++errors_;
  is_lost_ = after_pause_ == 0;
  spoil(is_lost_ ? bytes().size() : after_pause_);
}

/// Marks the next `count` bytes as not a frame. Only the newest of such bytes are kept, enough for
/// a frame and a stray byte.
void RtuFramer::spoil(std::size_t count) {
  spoilt_ += count;
  after_pause_ -= std::min(after_pause_, count);
  constexpr std::size_t kKept = kLongestFrame;
  if (spoilt_ <= kKept) return;
  const auto kept = std::span(buffer_).first(size_).subspan(spoilt_ - kKept);
  std::ranges::copy(kept, buffer_.begin());
  size_ = kept.size();
  spoilt_ = kKept;
}

/// Drops the next `count` bytes, a complete frame or bytes before a silence, and everything before
/// them.
void RtuFramer::drop(std::size_t count) {
  const auto rest = bytes().subspan(count);
  std::ranges::copy(rest, buffer_.begin());
  size_ = rest.size();
  spoilt_ = 0;
  after_pause_ -= std::min(after_pause_, count);
}

}  // namespace orbwatch::app::modbus
