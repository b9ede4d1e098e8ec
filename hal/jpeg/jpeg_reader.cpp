// SPDX-License-Identifier: Apache-2.0
#include "hal/jpeg/jpeg_reader.h"

#include <jerror.h>

#include <algorithm>

namespace orbwatch::hal {
namespace {

/// A progressive picture may have any number of scans; the limit bounds the time of a hostile one.
constexpr int kMostScans = 500;

constexpr const char* kDamaged = "damaged JPEG picture: ";

}  // namespace

JpegReader::JpegReader() { create(); }

JpegReader::~JpegReader() { jpeg_destroy_decompress(&picture_); }

/// Runs a call of libjpeg; false when it failed. libjpeg's only way out of a failed call is
/// longjmp, which skips destructors: `call`, and all that it calls, must have none to run.
template <class Call>
bool JpegReader::completes(Call call) {
  if (setjmp(way_out_) != 0) return false;
  call();
  return true;
}

void JpegReader::leave() { std::longjmp(way_out_, 1); }

void JpegReader::on_error(j_common_ptr picture) {
  auto& reader = *static_cast<JpegReader*>(picture->client_data);
  picture->err->format_message(picture, reader.message_);
  reader.leave();
}

void JpegReader::on_bad_marker(j_common_ptr picture) {
  static_cast<JpegReader*>(picture->client_data)->met_bad_marker_ = true;
  on_error(picture);
}

/// Levels below 0 are warnings, the others traces.
void JpegReader::on_message(j_common_ptr picture, int level) {
  if (level >= 0) return;
  auto& reader = *static_cast<JpegReader*>(picture->client_data);
  switch (picture->err->msg_code) {
    case JWRN_EXTRANEOUS_DATA:
      reader.has_padding_ = true;
      return;
    case JWRN_JPEG_EOF:  // finish() determines whether more than the end marker is missing
      reader.broke_off_ = true;
      return;
    default:
      on_error(picture);
  }
}

void JpegReader::on_progress(j_common_ptr picture) {
  auto& reader = *static_cast<JpegReader*>(picture->client_data);
  if (reader.picture_.input_scan_number <= kMostScans) return;
  std::snprintf(reader.message_, sizeof(reader.message_), "has more than %d scans", kMostScans);
  reader.leave();
}

void JpegReader::create() {
  picture_.err = jpeg_std_error(&errors_);
  picture_.client_data = this;
  errors_.error_exit = on_bad_marker;
  errors_.emit_message = on_message;
  progress_.progress_monitor = on_progress;
  is_created_ = completes([this] { jpeg_create_decompress(&picture_); });
  picture_.progress = &progress_;
}

/// After a bad header, libjpeg-turbo 2.1 reads the next picture as the rest of it, and it keeps the
/// tables of damaged pictures. So it is created again after an error.
void JpegReader::create_again() {
  jpeg_destroy_decompress(&picture_);
  create();
}

Result<> JpegReader::failed(const char* what) {
  std::string message = std::string(what) + message_;
  create_again();
  return fail(std::move(message));
}

/// Offset of the marker at which libjpeg gave up: it reads a marker's code before it judges.
std::size_t JpegReader::bytes_before_marker() const {
  const std::size_t read = jpeg_.size() - std::min(jpeg_.size(), picture_.src->bytes_in_buffer);
  const bool is_behind = read >= 2 && jpeg_[read - 2] == std::byte{0xff};
  return is_behind ? read - 2 : read;
}

Result<> JpegReader::open(std::span<const std::byte> jpeg) {
  if (!is_created_) return fail("JPEG decoder: out of memory");
  has_padding_ = false;
  broke_off_ = false;
  met_bad_marker_ = false;
  jpeg_ = jpeg;
  const auto* const bytes = reinterpret_cast<const unsigned char*>(jpeg.data());
  const bool read = completes([this, bytes, size = jpeg.size()] {
    jpeg_abort_decompress(&picture_);
    jpeg_mem_src(&picture_, bytes, size);
    jpeg_read_header(&picture_, TRUE);
  });
  if (!read) return failed("not a JPEG picture: ");
  return {};
}

/// Pictures of several scans are read to their end here. If other data follows a scan that could be
/// the last one, the picture is read again without it, since libjpeg cannot resume.
template <class Call>
Result<> JpegReader::start(Call call) {
  if (completes(call)) return {};
  if (!met_bad_marker_) return failed(kDamaged);
  broke_off_ = true;
  if (!is_complete()) return failed(kDamaged);
  const std::span<const std::byte> before = jpeg_.first(bytes_before_marker());
  create_again();
  return open(before).and_then([&] { return completes(call) ? Result<>() : failed(kDamaged); });
}

// Both starts keep libjpeg's accurate transform, also for cameras' streams, which are measured: the
// fast one saves about 5 % of the time and costs 0.3 dB at quality 85, 0.6 dB at 93 and 2 dB and
// more at 95 (photographs of 1024x512 on x86-64).

Result<> JpegReader::start_rows(J_COLOR_SPACE colours, unsigned reduction) {
  return start([this, colours, reduction] {
    picture_.out_color_space = colours;
    picture_.scale_num = 1;
    picture_.scale_denom = reduction;
    jpeg_start_decompress(&picture_);
  });
}

Result<> JpegReader::read_rows(const ImageView<std::uint8_t>& target) {
  const bool read = completes([this, &target] {
    while (picture_.output_scanline < picture_.output_height) {
      JSAMPROW row = target.row(static_cast<int>(picture_.output_scanline));
      jpeg_read_scanlines(&picture_, &row, 1);
    }
  });
  if (!read) return failed(kDamaged);
  return {};
}

Result<> JpegReader::start_components() {
  return start([this] {
    picture_.raw_data_out = TRUE;
    jpeg_start_decompress(&picture_);
  });
}

Result<> JpegReader::read_components(JSAMPIMAGE rows) {
  const bool read = completes([this, rows] {
    jpeg_read_raw_data(&picture_, rows,
                       static_cast<JDIMENSION>(picture_.max_v_samp_factor * DCTSIZE));
  });
  if (!read) return failed(kDamaged);
  return {};
}

Result<> JpegReader::finish() {
  // Data in memory never makes libjpeg wait for more: it reaches an end.
  const bool ended = completes([this] {
    while (jpeg_consume_input(&picture_) != JPEG_REACHED_EOI) {
    }
  });
  broke_off_ |= !ended;
  picture_bytes_ = ended ? jpeg_.size() - std::min(jpeg_.size(), picture_.src->bytes_in_buffer)
                         : bytes_before_marker();
  const bool is_whole = is_complete();
  if (!ended && !is_whole) return failed(kDamaged);
  if (!ended) create_again();
  if (!is_whole) return fail("damaged JPEG picture: ends early");
  return {};
}

/// Libjpeg has warned of data missing inside a Huffman-coded scan. It reports neither missing scans
/// nor missing data of an arithmetic-coded one.
bool JpegReader::is_complete() const {
  const std::span components(picture_.comp_info, static_cast<std::size_t>(picture_.num_components));
  const bool each_has_a_scan = std::ranges::all_of(
      components, [](const auto& component) { return component.quant_table != nullptr; });
  if (!each_has_a_scan || !broke_off_) return each_has_a_scan;
  if (picture_.arith_code != FALSE) return false;
  if (picture_.coef_bits == nullptr) return true;
  // For a progressive picture: the bits that each coefficient still lacks, -1 for all.
  return std::ranges::all_of(
      std::span(picture_.coef_bits, components.size()),
      [](const auto& bits) { return std::ranges::all_of(bits, [](int b) { return b == 0; }); });
}

}  // namespace orbwatch::hal
