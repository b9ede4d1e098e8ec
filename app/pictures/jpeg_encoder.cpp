#include "app/pictures/jpeg_encoder.h"

#include <turbojpeg.h>

#include <string>

#include "app/pictures/picture_conversion.h"

namespace orbwatch::app {

JpegEncoder::JpegEncoder() : encoder_(tjInitCompress()) {}

void JpegEncoder::Close::operator()(void* encoder) const { tjDestroy(encoder); }

Result<std::span<std::uint8_t>> JpegEncoder::encode(const Picture& picture, int quality) {
  if (!encoder_) return fail("JPEG encoder: out of memory");
  const bool grey = info(picture.format).colour == ColourModel::Luminance;
  const int layout = grey ? TJPF_GRAY : picture.format == PixelFormat::Bgr ? TJPF_BGR : TJPF_RGB;
  const bool as_it_is = picture.format == PixelFormat::Grey || picture.format == PixelFormat::Rgb ||
                        picture.format == PixelFormat::Bgr;
  const std::byte* pixels = picture.planes[0].data;
  auto stride = static_cast<int>(picture.planes[0].stride);
  if (!as_it_is) {
    const PixelFormat to = grey ? PixelFormat::Grey : PixelFormat::Rgb;
    converted_.resize(packed_bytes(to, picture.width, picture.height));
    convert(picture, to, converted_.data());
    pixels = converted_.data();
    stride = row_bytes(to, picture.width);
  }
  const int chroma = grey ? TJSAMP_GRAY : TJSAMP_420;
  jpeg_.resize(tjBufSize(picture.width, picture.height, chroma));
  unsigned char* out = jpeg_.data();
  auto size = static_cast<unsigned long>(jpeg_.size());
  if (tjCompress2(encoder_.get(), reinterpret_cast<const unsigned char*>(pixels), picture.width,
                  stride, picture.height, layout, &out, &size, chroma, quality,
                  TJFLAG_NOREALLOC) != 0) {
    return fail(std::string("JPEG encoder: ") + tjGetErrorStr2(encoder_.get()));
  }
  return std::span(jpeg_.data(), size);
}

}  // namespace orbwatch::app
