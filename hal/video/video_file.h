// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include "hal/replay/recording.h"
#include "proc/image/result.h"

namespace orbwatch::hal {

/// A video file, decoded by FFmpeg through OpenCV: 8 bit colour. Pictures are decoded in order; a
/// later number is reached by decoding those in between, an earlier one from the start.
class VideoFile : public Recording {
 public:
  /// Errors: not a video, its first picture cannot be decoded.
  static Result<std::unique_ptr<Recording>> open(const std::filesystem::path& file, bool loop);
  ~VideoFile() override;

  const StreamFormat& format() const override { return format_; }
  DeviceResult<> show(std::uint64_t number, FrameBuffer& target,
                      const std::stop_token& stop) override;

 private:
  struct Decoder;  // keeps OpenCV out of this header

  VideoFile(std::filesystem::path file, bool loop);

  /// Returns to the start; false when the file can no longer be opened.
  bool rewind();
  /// Decodes forward up to picture `number`; false when the recording ends before it.
  bool skip_to(std::uint64_t number, const std::stop_token& stop);
  /// Decodes the next picture; false at the end.
  bool decode_next();
  DeviceResult<> copy_to(FrameBuffer& target) const;

  std::filesystem::path file_;
  bool loop_;
  StreamFormat format_;
  std::unique_ptr<Decoder> decoder_;
  std::uint64_t position_ = 0;  ///< number of the next picture to decode
  std::optional<std::uint64_t>
      count_;  ///< known once the end was reached; headers only estimate it
};

}  // namespace orbwatch::hal
