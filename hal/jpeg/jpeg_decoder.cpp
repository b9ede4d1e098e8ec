#include "hal/jpeg/jpeg_decoder.h"

#include <turbojpeg.h>

#include <string>
#include <utility>

namespace orbwatch::hal {
namespace {

// A progressive picture may carry any number of scans over the same pixels; the limit keeps a
// hostile one from taking minutes.
constexpr int kStrict = TJFLAG_STOPONWARNING | TJFLAG_LIMITSCANS;

const unsigned char* bytes(std::span<const std::byte> jpeg) {
  return reinterpret_cast<const unsigned char*>(jpeg.data());
}

}  // namespace

JpegDecoder::JpegDecoder() : decoder_(tjInitDecompress()) {}

void JpegDecoder::Close::operator()(void* decoder) const { tjDestroy(decoder); }

/// libjpeg-turbo 2.1 stays in the middle of a header that it could not read and takes the next
/// picture for its rest; and it keeps the tables of damaged ones. So after an error it is made
/// anew.
tl::unexpected<Error> JpegDecoder::failed(const char* what) {
  std::string message = std::string(what) + tjGetErrorStr2(decoder_.get());
  decoder_.reset(tjInitDecompress());
  return fail(std::move(message));
}

Result<JpegSize> JpegDecoder::read_size(std::span<const std::byte> jpeg) {
  if (!decoder_) return fail("JPEG decoder: out of memory");
  JpegSize size;
  int subsampling = 0;
  int colours = 0;
  if (tjDecompressHeader3(decoder_.get(), bytes(jpeg), jpeg.size(), &size.width, &size.height,
                          &subsampling, &colours) != 0) {
    return failed("not a JPEG picture: ");
  }
  if (size.width == 0 || size.height == 0) return fail("not a JPEG picture: ends before its size");
  if (colours == TJCS_CMYK || colours == TJCS_YCCK) {
    return fail("a CMYK JPEG picture; grey and YCbCr are read");
  }
  return size;
}

Result<> JpegDecoder::check(std::span<const std::byte> jpeg) {
  const auto size = read_size(jpeg);
  if (!size) return tl::unexpected(size.error());
  // At an eighth, the entropy-coded data is read as for the full picture and little else is done.
  constexpr tjscalingfactor kEighth{1, 8};
  const int width = TJSCALED(size->width, kEighth);
  const int height = TJSCALED(size->height, kEighth);
  thumbnail_.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 3);
  return decompress(jpeg, {thumbnail_.data(), width, height, 3, std::ptrdiff_t{width} * 3});
}

Result<> JpegDecoder::decode_rgb(std::span<const std::byte> jpeg, ImageView<std::uint8_t> target) {
  const auto size = read_size(jpeg);
  if (!size) return tl::unexpected(size.error());
  if (size->width != target.width || size->height != target.height) {
    return fail("a JPEG picture of " + std::to_string(size->width) + "x" +
                std::to_string(size->height) + " instead of " + std::to_string(target.width) + "x" +
                std::to_string(target.height));
  }
  return decompress(jpeg, target);
}

Result<> JpegDecoder::decompress(std::span<const std::byte> jpeg, ImageView<std::uint8_t> target) {
  if (tjDecompress2(decoder_.get(), bytes(jpeg), jpeg.size(), target.data, target.width,
                    static_cast<int>(target.stride), target.height, TJPF_RGB, kStrict) != 0) {
    return failed("damaged JPEG picture: ");
  }
  return {};
}

}  // namespace orbwatch::hal
