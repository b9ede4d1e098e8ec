// SPDX-License-Identifier: Apache-2.0
#include "hal/jpeg/jpeg_decoder.h"

#include <algorithm>
#include <cstring>
#include <string>

#include "hal/jpeg/jpeg_reader.h"

namespace orbwatch::hal {
namespace {

constexpr std::uint8_t kNeutral = 128;

/// Writes one row of pairs from rows of one plane, whose pairs have columns x rows samples.
template <int columns>
void write_row(const std::uint8_t* upper, const std::uint8_t* lower, int count,
               std::uint8_t* pairs) {
  for (int x = 0; x < count; ++x) {
    unsigned sum = 0;
    for (int i = 0; i < columns; ++i)
      sum += unsigned{upper[columns * x + i]} + lower[columns * x + i];
    pairs[2 * x] = static_cast<std::uint8_t>((sum + columns) / (2 * columns));
  }
}

/// Writes a row of pairs of which two share a sample.
void write_shared_row(const std::uint8_t* upper, const std::uint8_t* lower, int count,
                      std::uint8_t* pairs) {
  for (int x = 0; x < count; ++x) {
    pairs[2 * x] = static_cast<std::uint8_t>((unsigned{upper[x / 2]} + lower[x / 2] + 1) / 2);
  }
}

/// Writes every other sample of the pairs, from the first on.
void write_plane(const ImageView<const std::uint8_t>& plane, const ImageView<std::uint8_t>& pairs) {
  const int rows = plane.height / pairs.height;
  for (int y = 0; y < pairs.height; ++y) {
    // Planes with as many rows: the mean combines a row with itself.
    const std::uint8_t* const upper = plane.row(rows * y);
    const std::uint8_t* const lower = plane.row(rows * y + rows - 1);
    if (plane.width == pairs.width) {
      write_row<1>(upper, lower, pairs.width, pairs.row(y));
    } else if (plane.width > pairs.width) {
      write_row<2>(upper, lower, pairs.width, pairs.row(y));
    } else {
      write_shared_row(upper, lower, pairs.width, pairs.row(y));
    }
  }
}

/// Interleaves planes of U and V to Nv12: `pairs` has 2 channels and one pixel for 2x2 of the
/// picture. In each direction the planes have as many pixels as `pairs`, twice as many (averaged),
/// or half as many columns (repeated); empty planes become neutral chroma.
void interleave_chroma(const ImageView<const std::uint8_t>& u,
                       const ImageView<const std::uint8_t>& v,
                       const ImageView<std::uint8_t>& pairs) {
  if (u.width == 0 || v.width == 0) {
    for (int y = 0; y < pairs.height; ++y) {
      std::fill_n(pairs.row(y), 2 * pairs.width, kNeutral);
    }
    return;
  }
  ImageView<std::uint8_t> second = pairs;
  ++second.data;
  write_plane(u, pairs);
  write_plane(v, second);
}

/// Samples of the picture that one sample of the component covers, in each direction.
struct Coverage {
  int columns = 0;
  int rows = 0;
  bool operator==(const Coverage&) const = default;
};

Coverage coverage(const jpeg_decompress_struct& picture, std::size_t component) {
  const jpeg_component_info& info = picture.comp_info[component];
  const int columns = picture.max_h_samp_factor;
  const int rows = picture.max_v_samp_factor;
  if (columns % info.h_samp_factor != 0 || rows % info.v_samp_factor != 0) return {};
  return {columns / info.h_samp_factor, rows / info.v_samp_factor};
}

/// Checks that write_strip() can make Nv12 of the picture.
Result<> check_components(const jpeg_decompress_struct& picture) {
  if (picture.num_components == 1) return {};
  if (picture.jpeg_color_space != JCS_YCbCr) {
    return fail("an RGB JPEG picture; grey and YCbCr are read");
  }
  const Coverage chroma = coverage(picture, 1);
  const bool known = (chroma.columns == 1 || chroma.columns == 2 || chroma.columns == 4) &&
                     (chroma.rows == 1 || chroma.rows == 2);
  if (!known || coverage(picture, 2) != chroma || coverage(picture, 0) != Coverage{1, 1}) {
    return fail(
        "a JPEG picture of unusual subsampling; chroma for 1, 2 or 4 columns and for 1 or "
        "2 rows is read");
  }
  return {};
}

int rows_of_strip(const jpeg_component_info& component) {
  return component.v_samp_factor * DCTSIZE;
}

}  // namespace

JpegDecoder::JpegDecoder() : reader_(std::make_unique<JpegReader>()) {}
JpegDecoder::~JpegDecoder() = default;

bool JpegDecoder::is_flawed() const { return reader_->is_flawed(); }

std::size_t JpegDecoder::picture_bytes() const { return reader_->picture_bytes(); }

Result<JpegSize> JpegDecoder::read_size(std::span<const std::byte> jpeg) {
  if (auto opened = reader_->open(jpeg); !opened) return tl::unexpected(opened.error());
  const jpeg_decompress_struct& picture = reader_->picture();
  const J_COLOR_SPACE colours = picture.jpeg_color_space;
  if (colours != JCS_GRAYSCALE && colours != JCS_YCbCr && colours != JCS_RGB) {
    return fail("a CMYK JPEG picture; grey and YCbCr are read");
  }
  return JpegSize{static_cast<int>(picture.image_width), static_cast<int>(picture.image_height),
                  colours == JCS_GRAYSCALE};
}

Result<> JpegDecoder::open(int width, int height, std::span<const std::byte> jpeg) {
  const auto size = read_size(jpeg);
  if (!size) return tl::unexpected(size.error());
  if (size->width == width && size->height == height) return {};
  return fail("a JPEG picture of " + std::to_string(size->width) + "x" +
              std::to_string(size->height) + " instead of " + std::to_string(width) + "x" +
              std::to_string(height));
}

Result<> JpegDecoder::check(std::span<const std::byte> jpeg) {
  if (const auto size = read_size(jpeg); !size) return tl::unexpected(size.error());
  // At an eighth of the size, the entropy-coded data is still read completely.
  if (auto started = reader_->start_rows(JCS_GRAYSCALE, 8); !started) return started;
  const auto width = static_cast<int>(reader_->picture().output_width);
  const auto height = static_cast<int>(reader_->picture().output_height);
  thumbnail_.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  return reader_->read_rows({thumbnail_.data(), width, height, 1, width}).and_then([this] {
    return reader_->finish();
  });
}

Result<> JpegDecoder::decode_packed(std::span<const std::byte> jpeg,
                                    const ImageView<std::uint8_t>& target) {
  const J_COLOR_SPACE colours = target.channels == 1 ? JCS_GRAYSCALE : JCS_RGB;
  return open(target.width, target.height, jpeg)
      .and_then([&] { return reader_->start_rows(colours, 1); })
      .and_then([&] { return reader_->read_rows(target); })
      .and_then([this] { return reader_->finish(); });
}

Result<> JpegDecoder::decode_nv12(std::span<const std::byte> jpeg, const MutablePicture& target) {
  return open(target.width, target.height, jpeg)
      .and_then([this] { return check_components(reader_->picture()); })
      .and_then([this] { return reader_->start_components(); })
      .and_then([&] { return read_strips(target); })
      .and_then([this] { return reader_->finish(); });
}

Result<> JpegDecoder::read_strips(const MutablePicture& target) {
  prepare_strips();
  std::array<JSAMPARRAY, 3> rows{rows_[0].data(), rows_[1].data(), rows_[2].data()};
  const int step = reader_->picture().max_v_samp_factor * DCTSIZE;
  for (int y = 0; y < target.height; y += step) {
    if (auto read = reader_->read_components(rows.data()); !read) return read;
    write_strip(y, std::min(step, target.height - y), target);
  }
  return {};
}

/// Makes room for one row of MCUs of each component, whole blocks wide as libjpeg writes them.
void JpegDecoder::prepare_strips() {
  const jpeg_decompress_struct& picture = reader_->picture();
  for (std::size_t n = 0; n < strips_.size(); ++n) {
    rows_[n].clear();
    if (n >= static_cast<std::size_t>(picture.num_components)) continue;
    const jpeg_component_info& component = picture.comp_info[n];
    const std::size_t stride = std::size_t{component.width_in_blocks} * DCTSIZE;
    const auto count = static_cast<std::size_t>(rows_of_strip(component));
    strips_[n].resize(stride * count);
    for (std::size_t y = 0; y < count; ++y) rows_[n].push_back(strips_[n].data() + y * stride);
  }
}

/// A component's samples of the strip that was read last; empty without this component.
ImageView<const std::uint8_t> JpegDecoder::strip(std::size_t number, int height) const {
  if (rows_[number].empty()) return {};
  const jpeg_component_info& component = reader_->picture().comp_info[number];
  return {strips_[number].data(), static_cast<int>(component.downsampled_width), height, 1,
          static_cast<std::ptrdiff_t>(component.width_in_blocks) * DCTSIZE};
}

/// Writes the strip that was read last to `count` rows of the target from row `y` on.
void JpegDecoder::write_strip(int y, int count, const MutablePicture& target) const {
  const jpeg_decompress_struct& picture = reader_->picture();
  const auto luminance = strip(0, count);
  for (int row = 0; row < count; ++row) {
    std::memcpy(target.planes[0].data + (y + row) * target.planes[0].stride, luminance.row(row),
                static_cast<std::size_t>(target.width));
  }
  const int pairs_y = y / 2;
  const ImageView<std::uint8_t> pairs{
      reinterpret_cast<std::uint8_t*>(target.planes[1].data + pairs_y * target.planes[1].stride),
      target.width / 2, count / 2, 2, target.planes[1].stride};
  const int rows = picture.num_components == 1 ? 0 : count / coverage(picture, 1).rows;
  interleave_chroma(strip(1, rows), strip(2, rows), pairs);
}

}  // namespace orbwatch::hal
