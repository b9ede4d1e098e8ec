#include "hal/jpeg/jpeg_decoder.h"

#include <turbojpeg.h>

#include <algorithm>
#include <string>
#include <utility>

#include "hal/jpeg/interleave_chroma.h"

namespace orbwatch::hal {
namespace {

// A progressive picture may have any number of scans; the limit bounds the time of a hostile one.
constexpr int kStrict = TJFLAG_STOPONWARNING | TJFLAG_LIMITSCANS;

const unsigned char* bytes(std::span<const std::byte> jpeg) {
  return reinterpret_cast<const unsigned char*>(jpeg.data());
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
  const auto header = read_header(jpeg);
  if (!header) return tl::unexpected(header.error());
  return header->size;
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
  const auto header = read_header_of(target.width, target.height, jpeg);
  if (!header) return tl::unexpected(header.error());
  return decompress_grey(jpeg, target);
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
