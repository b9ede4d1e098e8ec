// SPDX-License-Identifier: Apache-2.0
#include "app/ports/recorder/export/pictures/avi_writer.h"

#include <algorithm>
#include <initializer_list>
#include <string_view>

namespace orbwatch::app::recorder {
namespace {

using hal::mcap::Bytes;
using hal::mcap::FieldWriter;

constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 31;
constexpr std::uint32_t kHasIndex = 0x10, kKeyFrame = 0x10;
constexpr std::size_t kChunkHead = 8, kIndexEntry = 16;

/// Name of a chunk: its four characters as a number.
constexpr std::uint32_t name(std::string_view text) {
  std::uint32_t number = 0;
  for (std::size_t k = 4; k-- > 0;) number = number << 8 | static_cast<unsigned char>(text[k]);
  return number;
}

void append_chunk(Bytes& out, std::string_view kind, const Bytes& content) {
  FieldWriter fields(out);
  fields(name(kind), static_cast<std::uint32_t>(content.size()));
  out.insert(out.end(), content.begin(), content.end());
}

/// A list of chunks.
Bytes list_of(std::string_view kind,
              std::initializer_list<std::pair<std::string_view, Bytes>> parts) {
  Bytes list;
  FieldWriter fields(list);
  fields(name(kind));
  for (const auto& part : parts) append_chunk(list, part.first, part.second);
  return list;
}

/// Numbers of 16 or 32 bit.
template <class... Numbers>
Bytes content_of(Numbers... numbers) {
  Bytes content;
  FieldWriter fields(content);
  fields(numbers...);
  return content;
}

}  // namespace

Result<AviWriter> AviWriter::create(const std::filesystem::path& path, const AviFormat& format) {
  auto file = ExportFile::create(path);
  if (!file) return tl::unexpected(file.error());
  AviWriter writer(std::move(*file), format);
  if (auto written = writer.file_.append(writer.header(0, 0)); !written) {
    return tl::unexpected(written.error());
  }
  writer.movie_ = writer.file_.size() - sizeof(std::uint32_t);  // its kind is part of the list
  return writer;
}

Bytes AviWriter::header(std::uint64_t file, std::uint64_t movie) const {
  const auto width = static_cast<std::uint32_t>(format_.width);
  const auto height = static_cast<std::uint32_t>(format_.height);
  const auto period = static_cast<std::uint32_t>(format_.period.count());
  constexpr std::uint32_t kSecond = 1'000'000, kNone = 0;
  const std::uint16_t right = static_cast<std::uint16_t>(width);
  const std::uint16_t bottom = static_cast<std::uint16_t>(height);
  const Bytes main = content_of(period, kNone, kNone, kHasIndex, pictures_, kNone, std::uint32_t{1},
                                largest_, width, height, kNone, kNone, kNone, kNone);
  const Bytes stream =
      content_of(name("vids"), name("MJPG"), kNone, kNone, kNone, period, kSecond, kNone, pictures_,
                 largest_, ~kNone, kNone, std::uint16_t{0}, std::uint16_t{0}, right, bottom);
  const Bytes bitmap =
      content_of(std::uint32_t{40}, width, height, std::uint16_t{1}, std::uint16_t{24},
                 name("MJPG"), 3 * width * height, kNone, kNone, kNone, kNone);
  const Bytes streams = list_of("strl", {{"strh", stream}, {"strf", bitmap}});
  const Bytes headers = list_of("hdrl", {{"avih", main}, {"LIST", streams}});

  Bytes head;
  FieldWriter fields(head);
  fields(name("RIFF"), static_cast<std::uint32_t>(file), name("AVI "));
  append_chunk(head, "LIST", headers);
  fields(name("LIST"), static_cast<std::uint32_t>(movie), name("movi"));
  return head;
}

Result<> AviWriter::add(std::span<const std::byte> jpeg) {
  const std::uint64_t bytes = kChunkHead + jpeg.size() + jpeg.size() % 2;
  if (file_.size() + bytes + index_.size() + kIndexEntry + kChunkHead > kMostBytes) {
    return fail("AVI has at most 2 GiB; choose a smaller range by --from and --to");
  }
  const auto size = static_cast<std::uint32_t>(jpeg.size());
  FieldWriter index(index_);
  index(name("00dc"), kKeyFrame, static_cast<std::uint32_t>(file_.size() - movie_), size);
  ++pictures_;
  largest_ = std::max(largest_, size);
  const std::byte padding{0};
  return file_.append(content_of(name("00dc"), size))
      .and_then([&] { return file_.append(jpeg); })
      .and_then([&] { return file_.append(std::span(&padding, jpeg.size() % 2)); });
}

Result<> AviWriter::finish() {
  const std::uint64_t movie = file_.size() - movie_;
  Bytes index;
  append_chunk(index, "idx1", index_);
  return file_.append(index)
      .and_then([&] { return file_.replace(0, header(file_.size() - kChunkHead, movie)); })
      .and_then([&] { return file_.sync(); });
}

}  // namespace orbwatch::app::recorder
