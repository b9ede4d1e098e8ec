// SPDX-License-Identifier: Apache-2.0
#include "hal/replay/picture_decoder.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <fstream>
#include <new>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <system_error>
#include <vector>

#include "hal/jpeg/jpeg_decoder.h"
#include "hal/replay/exif_orientation.h"
#include "hal/replay/png_check.h"

namespace orbwatch::hal {
namespace {

constexpr std::uintmax_t kMaxFileBytes = std::uintmax_t{1} << 30;

struct CheckedFile {
  std::uint32_t width = 0;  ///< width in the file, before the orientation is applied
  std::uint32_t height = 0;
  bool is_flawed = false;
  std::size_t jpeg_bytes = 0;  ///< size of a flawed JPEG picture, without the data that follows it

  std::uint32_t side() const { return std::max(width, height); }
};

/// OpenCV repairs a damaged file and reports it on stderr only; so the file is checked first.
Result<CheckedFile> check_file(std::span<const std::byte> file) {
  if (is_png(file)) {
    const auto size = check_png(file);
    if (!size) return tl::unexpected(size.error());
    return CheckedFile{size->width, size->height};
  }
  constexpr std::array kJpegStart{std::byte{0xff}, std::byte{0xd8}, std::byte{0xff}};
  if (file.size() < kJpegStart.size() ||
      !std::equal(kJpegStart.begin(), kJpegStart.end(), file.begin())) {
    return fail("is neither a JPEG nor a PNG picture");
  }
  JpegDecoder decoder;
  const auto size = decoder.read_size(file);
  if (!size) return tl::unexpected(size.error());
  CheckedFile checked{static_cast<std::uint32_t>(size->width),
                      static_cast<std::uint32_t>(size->height)};
  if (checked.side() > kMaxSide) return checked;
  if (auto whole = decoder.check(file); !whole) return tl::unexpected(whole.error());
  checked.is_flawed = decoder.is_flawed();
  checked.jpeg_bytes = decoder.picture_bytes();
  return checked;
}

Result<DecodedPicture> to_picture(const cv::Mat& image) {
  DecodedPicture decoded;
  Picture& picture = decoded.picture;
  constexpr std::array kFormats{
      std::pair{CV_8UC1, PixelFormat::Grey}, std::pair{CV_16UC1, PixelFormat::Y16},
      std::pair{CV_8UC3, PixelFormat::Rgb}, std::pair{CV_16UC3, PixelFormat::Rgb16}};
  const auto* const known =
      std::ranges::find(kFormats, image.type(), &std::pair<int, PixelFormat>::first);
  if (known == kFormats.end()) {
    return fail("has pixels of type " + cv::typeToString(image.type()) +
                "; 1 or 3 channels of 8 or 16 bit are read");
  }
  picture.format = known->second;
  picture.colour_space.range = ColourRange::Full;
  picture.width = image.cols;
  picture.height = image.rows;
  const auto stride = static_cast<std::size_t>(row_bytes(picture.format, picture.width));
  decoded.storage = std::make_unique_for_overwrite<std::byte[]>(
      stride * static_cast<std::size_t>(picture.height));
  picture.planes[0] = {decoded.storage.get(), static_cast<std::ptrdiff_t>(stride)};
  cv::Mat pixels(image.size(), image.type(), decoded.storage.get(), stride);
  if (image.channels() == 3) {
    cv::cvtColor(image, pixels, cv::COLOR_BGR2RGB);
  } else {
    image.copyTo(pixels);
  }
  return decoded;
}

/// Turns the picture upright by its EXIF orientation.
cv::Mat upright(const cv::Mat& image, int orientation) {
  constexpr int kFirstTransposed = 5;
  cv::Mat turned = image;
  if (orientation >= kFirstTransposed) cv::transpose(image, turned);
  constexpr int kUpsideDown = 0, kMirrored = 1, kBoth = -1;
  switch (orientation) {
    case 2:
    case 6:
      cv::flip(turned, turned, kMirrored);
      break;
    case 3:
    case 7:
      cv::flip(turned, turned, kBoth);
      break;
    case 4:
    case 8:
      cv::flip(turned, turned, kUpsideDown);
      break;
    default:
      break;
  }
  return turned;
}

/// OpenCV reads EXIF from the first APP1 segment only, so a JPEG picture is turned here.
cv::Mat decode_upright(std::span<const std::byte> file) {
  const cv::Mat bytes(1, static_cast<int>(file.size()), CV_8UC1,
                      const_cast<std::byte*>(file.data()));
  constexpr int kAsItIs = cv::IMREAD_ANYCOLOR | cv::IMREAD_ANYDEPTH;
  if (is_png(file)) return cv::imdecode(bytes, kAsItIs);
  return upright(cv::imdecode(bytes, kAsItIs | cv::IMREAD_IGNORE_ORIENTATION),
                 exif_orientation(file));
}

/// The picture's own data and an end marker, which OpenCV needs.
std::vector<std::byte> with_end_marker(std::span<const std::byte> jpeg) {
  std::vector<std::byte> ended(jpeg.begin(), jpeg.end());
  ended.insert(ended.end(), {std::byte{0xff}, std::byte{0xd9}});
  return ended;
}

Result<DecodedPicture> decode_checked(std::span<const std::byte> file) {
  try {
    const cv::Mat image = decode_upright(file);
    if (image.empty()) return fail("damaged picture: cannot be decoded");
    return to_picture(image);
  } catch (const cv::Exception& error) {
    return fail("cannot be decoded: " + error.err);
  } catch (const std::bad_alloc&) {
    return fail("cannot be decoded: out of memory");
  }
}

}  // namespace

std::string exif_note(const DecodedPicture& decoded) {
  if (!decoded.is_turned) return {};
  return "; its EXIF orientation turns its " + std::to_string(decoded.picture.height) + "x" +
         std::to_string(decoded.picture.width);
}

bool has_picture_name(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension == ".jpg" || extension == ".jpeg" || extension == ".png";
}

Result<DecodedPicture> decode_picture(std::span<const std::byte> file, std::string_view name) {
  const auto named = [name](const std::string& message) {
    return fail(std::string(name) + ": " + message);
  };
  if (file.size() > kMaxFileBytes) return named("is larger than 1 GiB");
  const auto checked = check_file(file);
  if (!checked) return named(checked.error().message);
  if (checked->side() > kMaxSide) {
    return named("is " + std::to_string(checked->side()) + " pixels long or wide; at most " +
                 std::to_string(kMaxSide) + " are read");
  }
  auto decoded = checked->is_flawed
                     ? decode_checked(with_end_marker(file.first(checked->jpeg_bytes)))
                     : decode_checked(file);
  if (!decoded) return named(decoded.error().message);
  decoded->is_flawed = checked->is_flawed;
  decoded->is_turned = static_cast<std::uint32_t>(decoded->picture.width) != checked->width;
  return decoded;
}

Result<DecodedPicture> read_picture(const std::filesystem::path& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (error) return fail(path.string() + ": " + error.message());
  if (!std::filesystem::is_regular_file(status)) return fail(path.string() + ": is not a file");
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (error) return fail(path.string() + ": " + error.message());
  if (size > kMaxFileBytes) return fail(path.string() + ": is larger than 1 GiB");
  std::vector<std::byte> file(size);
  std::ifstream stream(path, std::ios::binary);
  stream.read(reinterpret_cast<char*>(file.data()), static_cast<std::streamsize>(size));
  if (!stream) {
    return fail(path.string() + ": cannot be read: " + std::generic_category().message(errno));
  }
  return decode_picture(file, path.string());
}

}  // namespace orbwatch::hal
