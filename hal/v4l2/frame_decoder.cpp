#include "hal/v4l2/frame_decoder.h"

#include "hal/v4l2/demosaic.h"
#include "hal/v4l2/unpack.h"

namespace orbwatch::hal {

FrameDecoder::FrameDecoder(const V4l2Agreement& agreement)
    : agreement_(agreement),
      pool_(make_frame_pool(agreement.stream.format, agreement.stream.width,
                            agreement.stream.height)) {
  if (agreement.coding.mosaic == Mosaic::None || agreement.stream.format != PixelFormat::Bgr)
    return;
  prepare_demosaic();
  mosaic_.resize(static_cast<std::size_t>(agreement.stream.width) *
                 static_cast<std::size_t>(agreement.stream.height));
}

Result<std::shared_ptr<FrameBuffer>> FrameDecoder::decode(std::span<const std::byte> samples) {
  auto frame = pool_.acquire();
  if (!frame) return frame;
  frame->picture.colour_space = agreement_.stream.colour_space;
  const auto target = MutablePicture::contiguous(agreement_.stream.format, agreement_.stream.width,
                                                 agreement_.stream.height, frame->memory,
                                                 frame->picture.planes[0].stride);
  if (auto done = decode_into(target, samples); !done) return tl::unexpected(done.error());
  return frame;
}

Result<> FrameDecoder::decode_into(const MutablePicture& target,
                                   std::span<const std::byte> samples) {
  if (agreement_.coding.packing == Packing::Jpeg) return decode_jpeg(target, samples);
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
  const PixelCoding& coding = agreement_.coding;
  const ImageView<std::uint8_t> mosaic{mosaic_.data(), target.width, target.height, 1,
                                       target.width};
  for (int y = 0; y < target.height; ++y, rows += agreement_.layout.planes[0].stride) {
    unpack_row_to_8_bit(coding.packing, info(coding.format).bits, rows, target.width,
                        mosaic.row(y));
  }
  return demosaic(coding.mosaic, mosaic, target.samples<std::uint8_t>());
}

void FrameDecoder::unpack(const MutablePicture& target, const std::byte* rows) {
  const auto view = target.samples<std::uint16_t>();
  for (int y = 0; y < target.height; ++y, rows += agreement_.layout.planes[0].stride) {
    unpack_row(agreement_.coding.packing, rows, target.width, view.row(y));
  }
}

}  // namespace orbwatch::hal
