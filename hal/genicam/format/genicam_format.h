// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "hal/mosaic/mosaic.h"
#include "proc/image/pixel_format.h"

namespace orbwatch::hal {

/// Sample packings of GenICam's Pixel Format Naming Convention (PFNC).
enum class SamplePacking : std::uint8_t {
  None,   ///< layout of the PixelFormat: frames are forwarded in the buffer that was received
  Lsb10,  ///< "p": a stream of bits, lowest first: 4 samples in 5 bytes
  Lsb12,  ///< "p": 2 samples in 3 bytes
  Lsb14,  ///< "p": 4 samples in 7 bytes
  Gev10,  ///< "Packed", GigE Vision's: upper 8 bits, both lower 2 (bits 0 and 4), upper 8 bits
  Gev12,  ///< "Packed": upper 8 bits, both lower 4, upper 8 bits
};

/// Supported pixel format of GenICam, and the format of its decoded frames.
struct GenicamFormat {
  std::string_view name;  ///< name in PFNC
  std::uint32_t code;     ///< code in PFNC
  PixelFormat format;     ///< format of its unpacked samples; luminance for a mosaic
  SamplePacking packing = SamplePacking::None;
  Mosaic mosaic = Mosaic::None;
};

/// Formats in the order of preference of "auto": colour, mosaics, then luminance, deep before
/// shallow. The counts of Mono14, which thermal cameras send, are kept in the low bits of 16.
inline constexpr std::array kGenicamFormats{
    GenicamFormat{"RGB8", 0x02180014, PixelFormat::Rgb},
    GenicamFormat{"BGR8", 0x02180015, PixelFormat::Bgr},
    GenicamFormat{"YUV422_8", 0x02100032, PixelFormat::Yuyv},
    GenicamFormat{"YCbCr422_8", 0x0210003B, PixelFormat::Yuyv},
    GenicamFormat{"YUV422_8_UYVY", 0x0210001F, PixelFormat::Uyvy},
    GenicamFormat{"BayerRG8", 0x01080009, PixelFormat::Grey, SamplePacking::None, Mosaic::Rggb},
    GenicamFormat{"BayerGR8", 0x01080008, PixelFormat::Grey, SamplePacking::None, Mosaic::Grbg},
    GenicamFormat{"BayerGB8", 0x0108000A, PixelFormat::Grey, SamplePacking::None, Mosaic::Gbrg},
    GenicamFormat{"BayerBG8", 0x0108000B, PixelFormat::Grey, SamplePacking::None, Mosaic::Bggr},
    GenicamFormat{"BayerRG10", 0x0110000D, PixelFormat::Y10, SamplePacking::None, Mosaic::Rggb},
    GenicamFormat{"BayerGR10", 0x0110000C, PixelFormat::Y10, SamplePacking::None, Mosaic::Grbg},
    GenicamFormat{"BayerGB10", 0x0110000E, PixelFormat::Y10, SamplePacking::None, Mosaic::Gbrg},
    GenicamFormat{"BayerBG10", 0x0110000F, PixelFormat::Y10, SamplePacking::None, Mosaic::Bggr},
    GenicamFormat{"BayerRG10p", 0x010A0058, PixelFormat::Y10, SamplePacking::Lsb10, Mosaic::Rggb},
    GenicamFormat{"BayerGR10p", 0x010A0056, PixelFormat::Y10, SamplePacking::Lsb10, Mosaic::Grbg},
    GenicamFormat{"BayerGB10p", 0x010A0054, PixelFormat::Y10, SamplePacking::Lsb10, Mosaic::Gbrg},
    GenicamFormat{"BayerBG10p", 0x010A0052, PixelFormat::Y10, SamplePacking::Lsb10, Mosaic::Bggr},
    GenicamFormat{"BayerRG10Packed", 0x010C0027, PixelFormat::Y10, SamplePacking::Gev10,
                  Mosaic::Rggb},
    GenicamFormat{"BayerGR10Packed", 0x010C0026, PixelFormat::Y10, SamplePacking::Gev10,
                  Mosaic::Grbg},
    GenicamFormat{"BayerGB10Packed", 0x010C0028, PixelFormat::Y10, SamplePacking::Gev10,
                  Mosaic::Gbrg},
    GenicamFormat{"BayerBG10Packed", 0x010C0029, PixelFormat::Y10, SamplePacking::Gev10,
                  Mosaic::Bggr},
    GenicamFormat{"BayerRG12", 0x01100011, PixelFormat::Y12, SamplePacking::None, Mosaic::Rggb},
    GenicamFormat{"BayerGR12", 0x01100010, PixelFormat::Y12, SamplePacking::None, Mosaic::Grbg},
    GenicamFormat{"BayerGB12", 0x01100012, PixelFormat::Y12, SamplePacking::None, Mosaic::Gbrg},
    GenicamFormat{"BayerBG12", 0x01100013, PixelFormat::Y12, SamplePacking::None, Mosaic::Bggr},
    GenicamFormat{"BayerRG12p", 0x010C0059, PixelFormat::Y12, SamplePacking::Lsb12, Mosaic::Rggb},
    GenicamFormat{"BayerGR12p", 0x010C0057, PixelFormat::Y12, SamplePacking::Lsb12, Mosaic::Grbg},
    GenicamFormat{"BayerGB12p", 0x010C0055, PixelFormat::Y12, SamplePacking::Lsb12, Mosaic::Gbrg},
    GenicamFormat{"BayerBG12p", 0x010C0053, PixelFormat::Y12, SamplePacking::Lsb12, Mosaic::Bggr},
    GenicamFormat{"BayerRG12Packed", 0x010C002B, PixelFormat::Y12, SamplePacking::Gev12,
                  Mosaic::Rggb},
    GenicamFormat{"BayerGR12Packed", 0x010C002A, PixelFormat::Y12, SamplePacking::Gev12,
                  Mosaic::Grbg},
    GenicamFormat{"BayerGB12Packed", 0x010C002C, PixelFormat::Y12, SamplePacking::Gev12,
                  Mosaic::Gbrg},
    GenicamFormat{"BayerBG12Packed", 0x010C002D, PixelFormat::Y12, SamplePacking::Gev12,
                  Mosaic::Bggr},
    GenicamFormat{"Mono16", 0x01100007, PixelFormat::Y16},
    GenicamFormat{"Mono14", 0x01100025, PixelFormat::Y16},
    GenicamFormat{"Mono14p", 0x010E0104, PixelFormat::Y16, SamplePacking::Lsb14},
    GenicamFormat{"Mono12", 0x01100005, PixelFormat::Y12},
    GenicamFormat{"Mono12p", 0x010C0047, PixelFormat::Y12, SamplePacking::Lsb12},
    GenicamFormat{"Mono12Packed", 0x010C0006, PixelFormat::Y12, SamplePacking::Gev12},
    GenicamFormat{"Mono10", 0x01100003, PixelFormat::Y10},
    GenicamFormat{"Mono10p", 0x010A0046, PixelFormat::Y10, SamplePacking::Lsb10},
    GenicamFormat{"Mono10Packed", 0x010C0004, PixelFormat::Y10, SamplePacking::Gev10},
    GenicamFormat{"Mono8", 0x01080001, PixelFormat::Grey},
};

/// The entry of kGenicamFormats for a PFNC code, or nullptr.
const GenicamFormat* find_genicam_format(std::uint32_t code);

/// Finds an entry by its name.
const GenicamFormat* find_genicam_format(std::string_view name);

/// Format of the frames: with `colour`, a mosaic becomes Bgr of 8 bit.
PixelFormat frame_format(const GenicamFormat& format, bool colour);

/// True when frames are forwarded in the buffer that was received.
bool is_zero_copy(const GenicamFormat& format, bool colour);

/// True when the size is a multiple of the format's groups of pixels and of its mosaic.
bool is_whole(const GenicamFormat& format, int width, int height);

/// Bytes of a row on the wire, without padding; `width` is whole.
std::size_t sent_row_bytes(const GenicamFormat& format, int width);

}  // namespace orbwatch::hal
