// SPDX-License-Identifier: Apache-2.0
#include "app/ports/recorder/export/pictures/tiff_writer.h"

#include <bit>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "hal/mcap/fields.h"

namespace orbwatch::app::recorder {
namespace {

static_assert(std::endian::native == std::endian::little, "samples are written as they are");

using hal::mcap::Bytes;
using hal::mcap::FieldWriter;

enum class TiffType : std::uint16_t { Ascii = 2, Short = 3, Long = 4, Rational = 5 };

constexpr std::uint16_t kMagicNumber = 42;
constexpr std::size_t kLinkInHeader = 4, kEntryBytes = 12;

/// Directory of a page: entries of ascending tags, and behind them the values that are longer than
/// an entry has room for.
class Directory {
 public:
  /// `offset`: of the directory in the file; `entries`: their number.
  Directory(std::uint64_t offset, std::uint16_t entries)
      : values_at_(offset + 2 + entries * kEntryBytes + 4) {
    FieldWriter fields(entries_);
    fields(entries);
  }

  void add_short(std::uint16_t tag, std::uint16_t value) {
    entry(tag, TiffType::Short, 1)(value, std::uint16_t{0});
  }
  void add_long(std::uint16_t tag, std::uint32_t value) { entry(tag, TiffType::Long, 1)(value); }
  /// The same number for each sample of a pixel, 1 or 3.
  void add_shorts(std::uint16_t tag, std::uint16_t value, std::uint32_t count) {
    if (count == 1) return add_short(tag, value);
    entry(tag, TiffType::Short, count)(next_value());
    FieldWriter values(values_);
    for (std::uint32_t k = 0; k < count; ++k) values(value);
  }
  void add_rational(std::uint16_t tag, std::uint32_t numerator, std::uint32_t denominator) {
    entry(tag, TiffType::Rational, 1)(next_value());
    FieldWriter values(values_);
    values(numerator, denominator);
  }
  /// A text of more than three characters.
  void add_text(std::uint16_t tag, const std::string& text) {
    entry(tag, TiffType::Ascii, static_cast<std::uint32_t>(text.size() + 1))(next_value());
    const auto bytes = std::as_bytes(std::span(text.c_str(), text.size() + 1));
    values_.insert(values_.end(), bytes.begin(), bytes.end());
    if (values_.size() % 2 != 0) values_.push_back(std::byte{0});
  }

  /// Place of the next page's offset within the directory.
  std::size_t link() const { return entries_.size(); }
  /// The directory without a next page.
  Bytes bytes() const {
    Bytes all = entries_;
    FieldWriter fields(all);
    fields(std::uint32_t{0});
    all.insert(all.end(), values_.begin(), values_.end());
    return all;
  }

 private:
  FieldWriter entry(std::uint16_t tag, TiffType type, std::uint32_t count) {
    FieldWriter fields(entries_);
    fields(tag, static_cast<std::uint16_t>(type), count);
    return fields;
  }
  std::uint32_t next_value() const {
    return static_cast<std::uint32_t>(values_at_ + values_.size());
  }

  std::uint64_t values_at_;
  Bytes entries_, values_;
};

Directory directory_of(const Picture& picture, const std::string& description, std::uint64_t pixels,
                       std::uint64_t bytes, std::uint64_t offset) {
  const PixelFormatInfo& facts = info(picture.format);
  const auto samples = static_cast<std::uint16_t>(facts.channels());
  const auto bits = static_cast<std::uint16_t>(8 * facts.bytes_per_sample());
  const auto height = static_cast<std::uint32_t>(picture.height);
  const std::uint16_t photometric = samples == 1 ? 1 : 2;  // black is 0, or R G B
  Directory page(offset, 15);
  page.add_long(254, 2);  // NewSubfileType: a page of several
  page.add_long(256, static_cast<std::uint32_t>(picture.width));
  page.add_long(257, height);
  page.add_shorts(258, bits, samples);
  page.add_short(259, 1);  // Compression: none
  page.add_short(262, photometric);
  page.add_text(270, description);
  page.add_long(273, static_cast<std::uint32_t>(pixels));
  page.add_short(277, samples);
  page.add_long(278, height);  // RowsPerStrip
  page.add_long(279, static_cast<std::uint32_t>(bytes));
  page.add_rational(282, 1, 1);  // XResolution and YResolution: square pixels
  page.add_rational(283, 1, 1);
  page.add_short(296, 1);            // ResolutionUnit: none
  page.add_shorts(339, 1, samples);  // SampleFormat: unsigned
  return page;
}

}  // namespace

bool TiffWriter::can_write(PixelFormat format) {
  return info(format).colour == ColourModel::Luminance || format == PixelFormat::Rgb ||
         format == PixelFormat::Rgb16;
}

Result<TiffWriter> TiffWriter::create(const std::filesystem::path& path) {
  auto file = ExportFile::create(path);
  if (!file) return tl::unexpected(file.error());
  TiffWriter writer(std::move(*file));
  Bytes header{std::byte{'I'}, std::byte{'I'}};
  FieldWriter fields(header);
  fields(kMagicNumber, std::uint32_t{0});
  writer.link_ = kLinkInHeader;
  if (auto written = writer.file_.append(header); !written) return tl::unexpected(written.error());
  return writer;
}

Result<> TiffWriter::add(const Picture& picture, const std::string& description) {
  const auto stride = static_cast<std::size_t>(row_bytes(picture.format, picture.width));
  const std::size_t bytes = picture_bytes(picture.format, stride, picture.height);
  const std::uint64_t pixels = file_.size();
  const std::uint64_t offset = pixels + bytes + bytes % 2;  // at a word
  const Directory page = directory_of(picture, description, pixels, bytes, offset);
  const Bytes directory = page.bytes();
  if (offset + directory.size() > std::numeric_limits<std::uint32_t>::max()) {
    return fail("TIFF has at most 4 GiB; choose a smaller range by --from and --to");
  }
  Bytes link;
  FieldWriter fields(link);
  fields(static_cast<std::uint32_t>(offset));
  const std::byte padding{0};
  auto written = file_.append(std::span(picture.planes[0].data, bytes))
                     .and_then([&] { return file_.append(std::span(&padding, bytes % 2)); })
                     .and_then([&] { return file_.append(directory); })
                     .and_then([&] { return file_.replace(link_, link); });
  link_ = offset + page.link();
  return written;
}

}  // namespace orbwatch::app::recorder
