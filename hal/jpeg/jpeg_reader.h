#pragma once

#include <csetjmp>
#include <cstddef>
#include <cstdint>
#include <cstdio>  // jpeglib.h needs FILE
#include <span>
#include <string>

// After <cstdio>.
#include <jpeglib.h>

#include "proc/image/image_view.h"
#include "proc/image/result.h"

namespace orbwatch::hal {

/// libjpeg's decompressor, with its errors as values. It reads one picture after another: open(),
/// one of the starts, its reads until every row is there, finish(); or open() again at any point.
/// A warning of libjpeg is an error, but for the two of is_flawed(). Thread-bound.
class JpegReader {
 public:
  JpegReader();
  ~JpegReader();
  JpegReader(const JpegReader&) = delete;
  JpegReader& operator=(const JpegReader&) = delete;

  /// Reads the header; `jpeg` must live until the picture is finished. Errors: no JPEG picture,
  /// header damaged, out of memory.
  Result<> open(std::span<const std::byte> jpeg);

  /// The header after open(), the sizes of what is read after a start.
  const jpeg_decompress_struct& picture() const { return picture_; }

  /// Luminance at 1/`reduction` of the size: 1 or 8. Errors: as read_grey(), since pictures of
  /// several scans are read here.
  Result<> start_grey(unsigned reduction);
  /// Decodes all rows into `target`, of the picture's output size. Errors: damaged, more scans than
  /// a picture needs.
  Result<> read_grey(const ImageView<std::uint8_t>& target);

  /// The components as they were compressed. Errors: as start_grey().
  Result<> start_components();
  /// Decodes the next row of MCUs: DCTSIZE rows for each of a component's vertical samples, whole
  /// blocks wide. Errors: damaged.
  Result<> read_components(JSAMPIMAGE rows);

  /// Reads up to the end of the picture, or to what stands in place of its end marker. Errors: data
  /// is missing, or damaged.
  Result<> finish();

  /// The picture has more data before a marker than it needs, or lacks only its end marker, be it
  /// that the data ends there or that other data follows. Cameras send it so, and no pixel is
  /// missing; but too much data may also be the only trace of a bit that was sent wrong.
  bool is_flawed() const { return has_padding_ || broke_off_; }

  /// Bytes of the picture that was finished last, up to and with the end marker, if it has one,
  /// without other data that follows.
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
  std::jmp_buf way_out_{};  ///< of the call of libjpeg that is running
  char message_[JMSG_LENGTH_MAX]{};
  bool is_created_ = false;
  bool has_padding_ = false;
  bool broke_off_ = false;  ///< the data ended, or was other data, before the picture's end marker
  /// libjpeg gave up at a marker: it only warns of damage between them.
  bool met_bad_marker_ = false;
  std::span<const std::byte> jpeg_;  ///< since open()
  std::size_t picture_bytes_ = 0;
};

}  // namespace orbwatch::hal
