#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "hal/replay/picture_decoder.h"
#include "hal/replay/recording.h"

namespace orbwatch::hal {

/// Folders up to this size, decoded, are decoded once and kept: playing them costs one copy per
/// frame. Larger ones are decoded picture by picture while they play.
inline constexpr std::size_t kKeptFolderBytes = std::size_t{64} << 20;

/// True when `a` comes before `b` for people: digits count as numbers, so "f2" comes before "f10".
bool natural_order(std::string_view a, std::string_view b);

/// The JPEG and PNG pictures of one folder in natural order of their names; other files and hidden
/// ones are left alone.
class PictureFolder : public Recording {
 public:
  /// The format is that of the first picture. Errors: no pictures, the first cannot be decoded.
  static Result<std::unique_ptr<Recording>> open(const std::filesystem::path& folder, bool loop);

  const StreamFormat& format() const override { return format_; }
  Shown<> show(std::uint64_t number, FrameBuffer& target, const std::stop_token& stop) override;

 private:
  PictureFolder(std::vector<std::filesystem::path> files, bool loop, DecodedPicture first);

  Shown<DecodedPicture> load(std::size_t index) const;

  std::vector<std::filesystem::path> files_;
  bool loop_;
  StreamFormat format_;
  std::vector<Shown<DecodedPicture>> kept_;  ///< one per file, or empty when they are too large
};

}  // namespace orbwatch::hal
