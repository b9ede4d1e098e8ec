#include "hal/v4l2/format/frame_decoder.h"

#include "hal/v4l2/format/demosaic.h"
#include "hal/v4l2/format/unpack.h"

namespace orbwatch::hal {

FrameDecoder::FrameDecoder(const NegotiatedFormat& format)
    : format_(format),
      pool_(make_frame_pool(format.stream.format, format.stream.width, format.stream.height)) {
  if (format.coding.mosaic == Mosaic::None || format.stream.format != PixelFormat::Bgr) return;
  prepare_demosaic();
  mosaic_.resize(static_cast<std::size_t>(format.stream.width) *
                 static_cast<std::size_t>(format.stream.height));
}

Result<std::shared_ptr<FrameBuffer>> FrameDecoder::decode(std::span<const std::byte> samples) {
  auto frame = pool_.acquire();
  if (!frame) return frame;
  frame->picture.colour_space = format_.stream.colour_space;
  const auto target =
      MutablePicture::contiguous(format_.stream.format, format_.stream.width, format_.stream.height,
                                 frame->memory, frame->picture.planes[0].stride);
  if (auto done = decode_into(target, samples); !done) return tl::unexpected(done.error());
  return frame;
}

Result<> FrameDecoder::decode_into(const MutablePicture& target,
                                   std::span<const std::byte> samples) {
  if (format_.coding.packing == Packing::Jpeg) return decode_jpeg(target, samples);
  if (target.format == PixelFormat::Bgr) return decode_mosaic(target, samples.data());
  unpack(target, samples.data());
  return {};
}

Result<> FrameDecoder::decode_jpeg(const MutablePicture& target,
                                   std::span<const std::byte> samples) {
  if (target.format == PixelFormat::Nv12) return jpeg_.decode_nv12(samples, target);
  return jpeg_.decode_grey(samples, target.samples<std::uint8_t>());
}

Result<> FrameDecoder::decode_mosaic(const MutablePicture& target, const std::byte* rows) {
  const PixelCoding& coding = format_.coding;
  const ImageView<std::uint8_t> mosaic{mosaic_.data(), target.width, target.height, 1,
                                       target.width};
  for (int y = 0; y < target.height; ++y, rows += format_.layout.planes[0].stride) {
    unpack_row_to_8_bit(coding.packing, info(coding.format).bits, rows, target.width,
                        mosaic.row(y));
  }
  return demosaic(coding.mosaic, mosaic, target.samples<std::uint8_t>());
}

void FrameDecoder::unpack(const MutablePicture& target, const std::byte* rows) {
  const auto view = target.samples<std::uint16_t>();
  for (int y = 0; y < target.height; ++y, rows += format_.layout.planes[0].stride) {
    unpack_row(format_.coding.packing, rows, target.width, view.row(y));
  }
}

}  // namespace orbwatch::hal
