// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <csetjmp>
#include <cstddef>
#include <cstdint>
#include <cstdio>  // jpeglib.h needs FILE
#include <span>
#include <string>

// Needs <cstdio> before it.
#include <jpeglib.h>

#include "proc/image/image_view.h"
#include "proc/image/result.h"

namespace orbwatch::hal {

/// Wraps libjpeg's decompressor, with its errors as values. It reads one picture after another:
/// open(), one of the starts, its reads until every row is there, finish(); or open() again at any
/// point. A warning of libjpeg is an error, except the two of is_flawed(). Thread-bound.
class JpegReader {
 public:
  JpegReader();
  ~JpegReader();
  JpegReader(const JpegReader&) = delete;
  JpegReader& operator=(const JpegReader&) = delete;

  /// Reads the header; `jpeg` must live until the picture is finished. Errors: not a JPEG picture,
  /// header damaged, out of memory.
  Result<> open(std::span<const std::byte> jpeg);

  /// The header after open(); after a start, the sizes of the rows that are read.
  const jpeg_decompress_struct& picture() const { return picture_; }

  /// Rows of `colours` (JCS_GRAYSCALE or JCS_RGB) at 1/`reduction` of the size: 1 or 8. Errors: as
  /// read_rows(), since pictures of several scans are read here.
  Result<> start_rows(J_COLOR_SPACE colours, unsigned reduction);
  /// Decodes all rows into `target`, of the picture's output size and channels. Errors: damaged,
  /// more scans than a picture needs.
  Result<> read_rows(const ImageView<std::uint8_t>& target);

  /// Starts reading the components as they were compressed. Errors: as start_rows().
  Result<> start_components();
  /// Decodes the next row of MCUs: DCTSIZE rows for each of a component's vertical samples, whole
  /// blocks wide. Errors: damaged.
  Result<> read_components(JSAMPIMAGE rows);

  /// Reads up to the end of the picture, or to the data in place of its end marker. Errors: data is
  /// missing, or damaged.
  Result<> finish();

  /// True if the picture has more data before a marker than it needs, or lacks only its end marker,
  /// because the data ends there or because other data follows. Cameras send such pictures, and no
  /// pixel is missing; but surplus data may also be the only trace of a bit error.
  bool is_flawed() const { return has_padding_ || broke_off_; }

  /// Bytes of the picture that was finished last, including the end marker, if it has one, without
  /// other data that follows.
  std::size_t picture_bytes() const { return picture_bytes_; }

 private:
  void create();
  void create_again();
  template <class Call>
  bool completes(Call call);
  template <class Call>
  Result<> start(Call call);
  Result<> failed(const char* what);
  bool is_complete() const;
  std::size_t bytes_before_marker() const;

  [[noreturn]] void leave();
  [[noreturn]] static void on_error(j_common_ptr picture);
  [[noreturn]] static void on_bad_marker(j_common_ptr picture);
  static void on_message(j_common_ptr picture, int level);
  static void on_progress(j_common_ptr picture);

  jpeg_decompress_struct picture_{};
  jpeg_error_mgr errors_{};
  jpeg_progress_mgr progress_{};
  std::jmp_buf way_out_{};  ///< return point of the running call of libjpeg
  char message_[JMSG_LENGTH_MAX]{};
  bool is_created_ = false;
  bool has_padding_ = false;
  bool broke_off_ =
      false;  ///< the data ended, or other data followed, before the picture's end marker
  /// Libjpeg gave up at a marker; it only warns of damage between markers.
  bool met_bad_marker_ = false;
  std::span<const std::byte> jpeg_;  ///< data passed to open()
  std::size_t picture_bytes_ = 0;
};

}  // namespace orbwatch::hal
