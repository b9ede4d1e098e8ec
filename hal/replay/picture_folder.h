// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "hal/replay/picture_decoder.h"
#include "hal/replay/recording.h"
#include "proc/image/result.h"

namespace orbwatch::hal {

/// Folders up to this size, decoded, are decoded once and cached: a frame costs one copy. Larger
/// ones are decoded while they play.
inline constexpr std::size_t kKeptFolderBytes = std::size_t{64} << 20;

/// Natural order: digits count as numbers, so "f2" is before "f10".
bool natural_order(std::string_view a, std::string_view b);

/// The JPEG and PNG files of a folder in natural order of their names, without hidden ones; a
/// single file counts as a folder of one. Reentrant. Error: it cannot be read, or there are none.
Result<std::vector<std::filesystem::path>> pictures_in(const std::filesystem::path& folder);

/// Plays the JPEG and PNG pictures of one folder in natural order of their names, without other and
/// hidden files; a single picture counts as a folder of one.
class PictureFolder : public Recording {
 public:
  /// The format is that of the first picture. Errors: no pictures, the first cannot be decoded.
  static Result<std::unique_ptr<Recording>> open(const std::filesystem::path& folder, bool loop);

  const StreamFormat& format() const override { return format_; }
  std::string size_note() const override { return size_note_; }
  DeviceResult<> show(std::uint64_t number, FrameBuffer& target,
                      const std::stop_token& stop) override;

 private:
  PictureFolder(std::vector<std::filesystem::path> files, bool loop, DecodedPicture first);

  DeviceResult<DecodedPicture> load(std::size_t index) const;

  std::vector<std::filesystem::path> files_;
  bool loop_;
  StreamFormat format_;
  std::string size_note_;
  std::vector<DeviceResult<DecodedPicture>> kept_;  ///< one per file, or empty when too large
};

}  // namespace orbwatch::hal
