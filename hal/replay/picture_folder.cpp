// SPDX-License-Identifier: Apache-2.0
#include "hal/replay/picture_folder.h"

#include <algorithm>
#include <cctype>
#include <cstring>
#include <string>
#include <system_error>
#include <utility>

namespace orbwatch::hal {
namespace {

bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

/// Removes the number at the start of `text` and returns it without leading zeros.
std::string_view take_number(std::string_view& text) {
  const auto end = std::find_if_not(text.begin(), text.end(), is_digit);
  std::string_view number = text.substr(0, static_cast<std::size_t>(end - text.begin()));
  text.remove_prefix(number.size());
  number.remove_prefix(std::min(number.find_first_not_of('0'), number.size()));
  return number;
}

std::string describe(PixelFormat format, int width, int height) {
  return std::to_string(width) + "x" + std::to_string(height) + " " +
         std::string(info(format).name);
}

std::size_t picture_bytes(const StreamFormat& format) {
  return static_cast<std::size_t>(row_bytes(format.format, format.width)) *
         static_cast<std::size_t>(format.height);
}

}  // namespace

bool natural_order(std::string_view a, std::string_view b) {
  const std::pair whole{a, b};
  while (!a.empty() && !b.empty()) {
    if (is_digit(a.front()) && is_digit(b.front())) {
      const std::string_view left = take_number(a);
      const std::string_view right = take_number(b);
      if (left.size() != right.size()) return left.size() < right.size();
      if (left != right) return left < right;
    } else {
      if (a.front() != b.front()) return a.front() < b.front();
      a.remove_prefix(1);
      b.remove_prefix(1);
    }
  }
  if (a.empty() != b.empty()) return a.empty();
  return whole.first < whole.second;  // distinguishes "f1" and "f01"
}

Result<std::vector<std::filesystem::path>> pictures_in(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  std::error_code error;
  if (std::filesystem::is_regular_file(folder, error)) return std::vector{folder};
  std::filesystem::directory_iterator entry(folder, error);
  for (; !error && entry != std::filesystem::directory_iterator(); entry.increment(error)) {
    const auto& path = entry->path();
    const bool hidden = path.filename().string().starts_with('.');
    if (!hidden && has_picture_name(path)) files.push_back(path);
  }
  if (error) return fail(folder.string() + ": cannot be read: " + error.message());
  if (files.empty()) {
    return fail(folder.string() + ": no pictures in it; looked for *.jpg, *.jpeg and *.png");
  }
  std::sort(files.begin(), files.end(), [](const auto& a, const auto& b) {
    return natural_order(a.filename().string(), b.filename().string());
  });
  return files;
}

Result<std::unique_ptr<Recording>> PictureFolder::open(const std::filesystem::path& folder,
                                                       bool loop) {
  auto files = pictures_in(folder);
  if (!files) return tl::unexpected(files.error());
  auto first = read_picture(files->front());
  if (!first) return tl::unexpected(first.error());
  return std::unique_ptr<Recording>(new PictureFolder(std::move(*files), loop, std::move(*first)));
}

PictureFolder::PictureFolder(std::vector<std::filesystem::path> files, bool loop,
                             DecodedPicture first)
    : files_(std::move(files)), loop_(loop) {
  const Picture& picture = first.picture;
  format_ = {picture.format, picture.colour_space, picture.width, picture.height, 0.0};
  size_note_ = exif_note(first);
  if (picture_bytes(format_) > kKeptFolderBytes / files_.size()) return;
  kept_.reserve(files_.size());
  kept_.emplace_back(std::move(first));
  while (kept_.size() < files_.size()) kept_.push_back(load(kept_.size()));
}

DeviceResult<DecodedPicture> PictureFolder::load(std::size_t index) const {
  auto decoded = read_picture(files_[index]);
  if (!decoded) {
    return fail(Fault::CorruptFrame, decoded.error().message);
  }
  const Picture& picture = decoded->picture;
  if (picture.format != format_.format || picture.width != format_.width ||
      picture.height != format_.height) {
    return fail(Fault::WrongFormat, files_[index].string() + ": " +
                                        describe(picture.format, picture.width, picture.height) +
                                        exif_note(*decoded) + "; the first picture is " +
                                        describe(format_.format, format_.width, format_.height) +
                                        size_note_);
  }
  return std::move(*decoded);
}

DeviceResult<> PictureFolder::show(std::uint64_t number, FrameBuffer& target,
                                   const std::stop_token&) {
  if (!loop_ && number >= files_.size()) {
    return fail(Fault::Unplugged, "end of recording");
  }
  const auto index = static_cast<std::size_t>(number % files_.size());
  const auto copy = [&](const DeviceResult<DecodedPicture>& shown) -> DeviceResult<> {
    if (!shown) return tl::unexpected(shown.error());
    std::memcpy(target.memory, shown->storage.get(), picture_bytes(format_));
    if (shown->is_flawed) target.metadata.status = FrameStatus::Flawed;
    return {};
  };
  return kept_.empty() ? copy(load(index)) : copy(kept_[index]);
}

}  // namespace orbwatch::hal
