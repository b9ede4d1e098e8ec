// SPDX-License-Identifier: Apache-2.0
#include "hal/replay/picture_decoder.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstring>
#include <new>
#include <string>
#include <utility>

#include "hal/jpeg/jpeg_decoder.h"
#include "hal/png/png_decoder.h"
#include "hal/regular_file.h"
#include "hal/replay/exif_orientation.h"

namespace orbwatch::hal {
namespace {

constexpr std::size_t kMaxFileBytes = std::size_t{1} << 30;

/// A picture whose pixels are to be written.
struct NewPicture {
  DecodedPicture decoded;
  MutablePicture pixels;
};

/// Errors: a side above kMaxSide, out of memory.
Result<NewPicture> make_picture(PixelFormat format, int width, int height) {
  if (const int side = std::max(width, height); side > kMaxSide) {
    return fail("is " + std::to_string(side) + " pixels long or wide; at most " +
                std::to_string(kMaxSide) + " are read");
  }
  const int stride = row_bytes(format, width);
  NewPicture made;
  made.decoded.storage.reset(new (
      std::nothrow) std::byte[picture_bytes(format, static_cast<std::size_t>(stride), height)]);
  if (!made.decoded.storage) return fail("cannot be decoded: out of memory");
  made.pixels =
      MutablePicture::contiguous(format, width, height, made.decoded.storage.get(), stride);
  made.pixels.colour_space.range = ColourRange::Full;
  made.decoded.picture = made.pixels;
  return made;
}

/// Steps through a stored picture, in bytes, in the order of the upright picture's pixels.
struct Walk {
  const std::byte* first;
  std::ptrdiff_t column;
  std::ptrdiff_t row;
};

/// The least orientation, see exif_orientation(), that exchanges rows and columns.
constexpr int kFirstTransposed = 5;

Walk upright_walk(const Picture& stored, int pixel_bytes, int orientation) {
  constexpr std::array kFromRight{2, 3, 7, 8}, kFromBelow{3, 4, 6, 7};
  Walk walk{stored.planes[0].data, pixel_bytes, stored.planes[0].stride};
  if (std::ranges::count(kFromRight, orientation) > 0) {
    walk.first += (stored.width - 1) * walk.column;
    walk.column = -walk.column;
  }
  if (std::ranges::count(kFromBelow, orientation) > 0) {
    walk.first += (stored.height - 1) * walk.row;
    walk.row = -walk.row;
  }
  if (orientation >= kFirstTransposed) std::swap(walk.column, walk.row);
  return walk;
}

/// Turns the picture upright by its EXIF orientation. Error: out of memory.
Result<DecodedPicture> upright(DecodedPicture stored, int orientation) {
  if (orientation == 1) return stored;
  const Picture& from = stored.picture;
  const int pixel_bytes = row_bytes(from.format, 1);
  const Walk walk = upright_walk(from, pixel_bytes, orientation);
  const bool is_transposed = orientation >= kFirstTransposed;
  auto turned = make_picture(from.format, is_transposed ? from.height : from.width,
                             is_transposed ? from.width : from.height);
  if (!turned) return tl::unexpected(turned.error());
  const MutablePicture& to = turned->pixels;
  for (int y = 0; y < to.height; ++y) {
    const std::byte* pixel = walk.first + y * walk.row;
    std::byte* out = to.planes[0].data + y * to.planes[0].stride;
    for (int x = 0; x < to.width; ++x, pixel += walk.column, out += pixel_bytes) {
      std::memcpy(out, pixel, static_cast<std::size_t>(pixel_bytes));
    }
  }
  turned->decoded.is_flawed = stored.is_flawed;
  turned->decoded.is_turned = to.width != from.width;
  return std::move(turned->decoded);
}

Result<DecodedPicture> decode_png(std::span<const std::byte> file) {
  PngDecoder decoder;
  const auto header = decoder.open(file);
  if (!header) return tl::unexpected(header.error());
  auto made = make_picture(header->format, header->width, header->height);
  if (!made) return tl::unexpected(made.error());
  if (auto done = decoder.decode(made->pixels); !done) return tl::unexpected(done.error());
  return upright(std::move(made->decoded), tiff_orientation(decoder.exif()));
}

Result<DecodedPicture> decode_jpeg(std::span<const std::byte> file) {
  JpegDecoder decoder;
  const auto size = decoder.read_size(file);
  if (!size) return tl::unexpected(size.error());
  auto made =
      make_picture(size->is_grey ? PixelFormat::Grey : PixelFormat::Rgb, size->width, size->height);
  if (!made) return tl::unexpected(made.error());
  const auto done = decoder.decode_packed(file, made->pixels.samples<std::uint8_t>());
  if (!done) return tl::unexpected(done.error());
  made->decoded.is_flawed = decoder.is_flawed();
  return upright(std::move(made->decoded), exif_orientation(file));
}

Result<DecodedPicture> decode(std::span<const std::byte> file) {
  if (is_png(file)) return decode_png(file);
  constexpr std::array kJpegStart{std::byte{0xff}, std::byte{0xd8}, std::byte{0xff}};
  if (file.size() >= kJpegStart.size() &&
      std::equal(kJpegStart.begin(), kJpegStart.end(), file.begin())) {
    return decode_jpeg(file);
  }
  return fail("is neither a JPEG nor a PNG picture");
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
  auto decoded = decode(file);
  if (!decoded) return named(decoded.error().message);
  return decoded;
}

Result<DecodedPicture> read_picture(const std::filesystem::path& path) {
  return read_regular_file(path, kMaxFileBytes).and_then([&](const std::string& file) {
    return decode_picture(std::as_bytes(std::span(file)), path.string());
  });
}

}  // namespace orbwatch::hal
