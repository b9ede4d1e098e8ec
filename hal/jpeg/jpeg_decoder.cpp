#include "hal/jpeg/jpeg_decoder.h"

#include <turbojpeg.h>

#include <algorithm>
#include <string>
#include <utility>

namespace orbwatch::hal {
namespace {

// A progressive picture may have any number of scans; the limit bounds the time of a hostile one.
constexpr int kStrict = TJFLAG_STOPONWARNING | TJFLAG_LIMITSCANS;

const unsigned char* bytes(std::span<const std::byte> jpeg) {
  return reinterpret_cast<const unsigned char*>(jpeg.data());
}

constexpr std::uint8_t kNeutral = 128;

/// One row of pairs out of rows of one plane, where a pair has columns x rows samples.
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

/// The same where two pairs share a sample.
void write_shared_row(const std::uint8_t* upper, const std::uint8_t* lower, int count,
                      std::uint8_t* pairs) {
  for (int x = 0; x < count; ++x) {
    pairs[2 * x] = static_cast<std::uint8_t>((unsigned{upper[x / 2]} + lower[x / 2] + 1) / 2);
  }
}

/// Every other sample of the pairs, from their first on.
void write_plane(const ImageView<const std::uint8_t>& plane, const ImageView<std::uint8_t>& pairs) {
  const int rows = plane.height / pairs.height;
  for (int y = 0; y < pairs.height; ++y) {
    // Of planes with as many rows, the mean is of a row and itself.
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

/// Interleaves planes of U and V as Nv12: `pairs` has 2 channels and one pixel for 2x2 of the
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

}  // namespace

JpegDecoder::JpegDecoder() : decoder_(tjInitDecompress()) {}

void JpegDecoder::Close::operator()(void* decoder) const { tjDestroy(decoder); }

/// After a bad header, libjpeg-turbo 2.1 reads the next picture as the rest of it, and it keeps the
/// tables of damaged pictures. So it is created again after an error.
tl::unexpected<Error> JpegDecoder::failed(const char* what) {
  std::string message = std::string(what) + tjGetErrorStr2(decoder_.get());
  decoder_.reset(tjInitDecompress());
  return fail(std::move(message));
}

Result<JpegDecoder::Header> JpegDecoder::read_header(std::span<const std::byte> jpeg) {
  if (!decoder_) return fail("JPEG decoder: out of memory");
  Header header;
  JpegSize& size = header.size;
  if (tjDecompressHeader3(decoder_.get(), bytes(jpeg), jpeg.size(), &size.width, &size.height,
                          &header.subsampling, &header.colours) != 0) {
    return failed("not a JPEG picture: ");
  }
  if (size.width == 0 || size.height == 0) return fail("not a JPEG picture: ends before its size");
  if (header.colours == TJCS_CMYK || header.colours == TJCS_YCCK) {
    return fail("a CMYK JPEG picture; grey and YCbCr are read");
  }
  return header;
}

Result<JpegDecoder::Header> JpegDecoder::read_header_of(int width, int height,
                                                        std::span<const std::byte> jpeg) {
  auto header = read_header(jpeg);
  if (header && (header->size.width != width || header->size.height != height)) {
    return fail("a JPEG picture of " + std::to_string(header->size.width) + "x" +
                std::to_string(header->size.height) + " instead of " + std::to_string(width) + "x" +
                std::to_string(height));
  }
  return header;
}

Result<JpegSize> JpegDecoder::read_size(std::span<const std::byte> jpeg) {
  return read_header(jpeg).map([](const Header& header) { return header.size; });
}

Result<> JpegDecoder::check(std::span<const std::byte> jpeg) {
  const auto header = read_header(jpeg);
  if (!header) return tl::unexpected(header.error());
  // At an eighth of the size, the entropy-coded data is still read completely.
  constexpr tjscalingfactor kEighth{1, 8};
  const int width = TJSCALED(header->size.width, kEighth);
  const int height = TJSCALED(header->size.height, kEighth);
  thumbnail_.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  return decompress_grey(jpeg, {thumbnail_.data(), width, height, 1, width});
}

Result<> JpegDecoder::decode_grey(std::span<const std::byte> jpeg,
                                  const ImageView<std::uint8_t>& target) {
  return read_header_of(target.width, target.height, jpeg).and_then([&](const Header&) {
    return decompress_grey(jpeg, target);
  });
}

Result<> JpegDecoder::decompress_grey(std::span<const std::byte> jpeg,
                                      const ImageView<std::uint8_t>& target) {
  if (tjDecompress2(decoder_.get(), bytes(jpeg), jpeg.size(), target.data, target.width,
                    static_cast<int>(target.stride), target.height, TJPF_GRAY, kStrict) != 0) {
    return failed("damaged JPEG picture: ");
  }
  return {};
}

Result<> JpegDecoder::decode_nv12(std::span<const std::byte> jpeg, const MutablePicture& target) {
  const auto header = read_header_of(target.width, target.height, jpeg);
  if (!header) return tl::unexpected(header.error());
  const int subsampling = header->subsampling;
  if (header->colours == TJCS_RGB) return fail("an RGB JPEG picture; grey and YCbCr are read");
  if (tjPlaneWidth(0, target.width, subsampling) != target.width) {
    return fail("a JPEG picture with chroma shared by 4 pixels of a row, " +
                std::to_string(target.width) + " wide; it must be a multiple of 4");
  }
  const bool grey = subsampling == TJSAMP_GRAY;
  const int width = grey ? 0 : tjPlaneWidth(1, target.width, subsampling);
  const int height = grey ? 0 : tjPlaneHeight(1, target.height, subsampling);
  for (auto& plane : chroma_) {
    plane.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  }
  std::array<unsigned char*, 3> planes{reinterpret_cast<unsigned char*>(target.planes[0].data),
                                       chroma_[0].data(), chroma_[1].data()};
  std::array<int, 3> strides{static_cast<int>(target.planes[0].stride), width, width};
  if (tjDecompressToYUVPlanes(decoder_.get(), bytes(jpeg), jpeg.size(), planes.data(), target.width,
                              strides.data(), target.height, kStrict) != 0) {
    return failed("damaged JPEG picture: ");
  }
  const ImageView<std::uint8_t> pairs{reinterpret_cast<std::uint8_t*>(target.planes[1].data),
                                      target.width / 2, target.height / 2, 2,
                                      target.planes[1].stride};
  interleave_chroma({chroma_[0].data(), width, height, 1, width},
                    {chroma_[1].data(), width, height, 1, width}, pairs);
  return {};
}

}  // namespace orbwatch::hal
