// SPDX-License-Identifier: Apache-2.0
#include "hal/genicam/format/genicam_decoder.h"

#include "hal/genicam/format/unpack.h"
#include "hal/mosaic/demosaic.h"

namespace orbwatch::hal {

GenicamDecoder::GenicamDecoder(const GenicamStreamFormat& format, std::size_t buffers)
    : format_(format),
      pool_(make_frame_pool(format.stream.format, format.stream.width, format.stream.height,
                            buffers)) {
  if (format.stream.format != PixelFormat::Bgr) return;
  mosaic_.resize(static_cast<std::size_t>(format.stream.width) *
                 static_cast<std::size_t>(format.stream.height));
}

Result<std::shared_ptr<FrameBuffer>> GenicamDecoder::decode(const std::byte* rows,
                                                            std::size_t stride) {
  auto frame = pool_.acquire();
  if (!frame) return frame;
  const StreamFormat& stream = format_.stream;
  frame->picture.colour_space = stream.colour_space;
  const auto target = MutablePicture::contiguous(stream.format, stream.width, stream.height,
                                                 frame->memory, frame->picture.planes[0].stride);
  if (stream.format != PixelFormat::Bgr) {
    const auto samples = target.samples<std::uint16_t>();
    for (int y = 0; y < stream.height; ++y, rows += stride) {
      unpack_samples(format_.pixels->packing, rows, stream.width, samples.row(y));
    }
    return frame;
  }
  const ImageView<std::uint8_t> mosaic{mosaic_.data(), stream.width, stream.height, 1,
                                       stream.width};
  for (int y = 0; y < stream.height; ++y, rows += stride) {
    unpack_upper_bits(*format_.pixels, rows, stream.width, mosaic.row(y));
  }
  auto done = demosaic(format_.pixels->mosaic, mosaic, target.samples<std::uint8_t>());
  if (!done) return tl::unexpected(done.error());
  return frame;
}

}  // namespace orbwatch::hal
