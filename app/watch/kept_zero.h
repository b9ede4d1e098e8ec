// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "proc/align/drift/drift_monitor.h"
#include "proc/image/pixel_format.h"
#include "proc/image/result.h"

/// The file that keeps the zero of a camera's drift over restarts: a motion while the appliance is
/// off is measured, too. One file per camera, replaced atomically and accessible to its owner only,
/// since it holds a picture. Its size is bounded by that of the camera's picture.
namespace orbwatch::app {

/// Camera and alignment that a zero is valid for.
struct ZeroSubject {
  std::uint32_t alignment = 0;  ///< see alignment_checksum()
  int width = 0;                ///< px
  int height = 0;
  PixelFormat format = PixelFormat::Grey;  ///< of the luminance, see luminance_format()
};

/// A zero, and the picture that it refers to.
struct KeptZero {
  align::DriftZero zero;
  cv::Mat luminance;  ///< as luminance_of()
};

/// Format of the luminance of a picture: Grey, Y10, Y12 or Y16. Reentrant.
PixelFormat luminance_format(PixelFormat format);

/// The luminance as a picture. It shares the pixels. Reentrant.
Picture luminance_picture(const cv::Mat& luminance, PixelFormat format);

/// A camera's file in `folder`; empty without a folder: nothing is kept. Reentrant.
std::filesystem::path zero_file(const std::filesystem::path& folder, const std::string& camera);

/// Writes the file. Waits for the disk. Errors: those of hal::write_file(); no folder. Reentrant.
Result<> keep_zero(const std::filesystem::path& file, const ZeroSubject& subject,
                   const KeptZero& kept);

/// Reads the file; nullopt: there is none of this alignment. Error: it cannot be read, is damaged,
/// of another version, or for pictures of another size or format. Reentrant.
Result<std::optional<KeptZero>> kept_zero(const std::filesystem::path& file,
                                          const ZeroSubject& subject);

/// The same for the content of a file; the error is without its name. Reentrant.
Result<std::optional<KeptZero>> parsed_zero(std::string_view content, const ZeroSubject& subject);

}  // namespace orbwatch::app
