// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

namespace orbwatch::hal {

/// Numbers the frames of a stream by the camera's block ids, which GigE Vision 1 counts in 16 bits
/// without 0, and which are lost with a frame's first packet. Thread-bound.
class BlockCounter {
 public:
  /// The number of the next frame; its id is unknown if its first packet was lost. The number grows
  /// with the ids, and by 1 where they do not.
  std::uint32_t number(std::optional<std::uint64_t> id) {
    if (!id) return number_ + ++unknown_;
    const std::uint64_t step = has_id_ ? step_to(*id) : 0;
    // A frame without an id follows the frame before, and this frame follows it.
    const std::uint64_t least = has_id_ || unknown_ > 0 ? unknown_ + 1 : 0;
    number_ += static_cast<std::uint32_t>(step < least ? least : step);
    has_id_ = true;
    id_ = *id;
    unknown_ = 0;
    return number_;
  }

 private:
  static constexpr std::uint64_t kLastId = 0xffff;  ///< largest id of 16 bits; 1 follows

  std::uint64_t step_to(std::uint64_t id) const {
    if (id > id_) return id - id_;
    const bool wraps = id_ <= kLastId && id > 0 && id_ - id > kLastId / 2;
    return wraps ? id + kLastId - id_ : 0;
  }

  std::uint32_t number_ = 0;
  std::uint32_t unknown_ = 0;  ///< frames without an id since the last id
  bool has_id_ = false;
  std::uint64_t id_ = 0;
};

}  // namespace orbwatch::hal
