// SPDX-License-Identifier: Apache-2.0
#include "hal/mcap/record_file.h"

#include <algorithm>
#include <array>

namespace orbwatch::hal::mcap {
namespace {

std::size_t most_content(Opcode opcode, const Limits& limits) {
  if (opcode == Opcode::Chunk) return most_stored(limits);
  return opcode == Opcode::MessageIndex ? limits.chunk : limits.attachment;
}

}  // namespace

FileResult<std::optional<RecordHead>> read_head(const File& file, std::uint64_t offset,
                                                std::uint64_t size) {
  if (offset > size || size - offset < kRecordHead) return std::nullopt;
  std::array<std::byte, kRecordHead> bytes;
  if (auto done = file.read(offset, bytes); !done) return error_of(done);
  std::uint8_t opcode = 0;
  std::uint64_t length = 0;
  FieldReader fields(bytes);
  fields(opcode, length);
  if (length > size - offset - kRecordHead) return std::nullopt;
  return RecordHead{static_cast<Opcode>(opcode), length};
}

FileResult<RecordView> load_record(const File& file, std::uint64_t offset, const RecordHead& head,
                                   const Limits& limits, Bytes& buffer) {
  const std::size_t most = most_content(head.opcode, limits);
  if (head.length > most) {
    return file.named({0, place_of(head.opcode, offset) + ": " + std::to_string(head.length) +
                              " bytes long; at most " + std::to_string(most)});
  }
  const auto content = resized(buffer, static_cast<std::size_t>(head.length));
  if (auto done = file.read(offset + kRecordHead, content); !done) return error_of(done);
  return RecordView{head.opcode, content, offset};
}

FileResult<RecordView> load_listed(const File& file, Opcode opcode, std::uint64_t offset,
                                   std::uint64_t length, const Limits& limits, Bytes& buffer) {
  const auto size = file.size();
  if (!size) return tl::unexpected(size.error());
  auto head = read_head(file, offset, *size);
  if (!head) return error_of(head);
  if (*head && (*head)->opcode == opcode && (*head)->length + kRecordHead == length) {
    return load_record(file, offset, **head, limits, buffer);
  }
  return file.named({0, place_of(opcode, offset) + ", " + std::to_string(length) +
                            " bytes long: listed by the summary, but not there"});
}

FileResult<std::optional<FileBegin>> read_begin(const File& file, const Limits& limits) {
  const auto size = file.size();
  if (!size) return tl::unexpected(size.error());
  std::array<std::byte, kMagic.size()> magic{};
  const auto begin = std::span(magic).first(
      static_cast<std::size_t>(std::min<std::uint64_t>(*size, magic.size())));
  if (auto done = file.read(0, begin); !done) return error_of(done);
  if (!std::ranges::equal(begin, std::span(kMagic).first(begin.size()))) {
    return file.named({0, "byte 0: not an MCAP file; it must begin with \\x89MCAP0"});
  }
  auto head = read_head(file, kMagic.size(), *size);
  if (!head) return error_of(head);
  if (!*head) return std::nullopt;
  if ((*head)->opcode != Opcode::Header) {
    return file.named({0, place_of((*head)->opcode, kMagic.size()) + ": it must be the header"});
  }
  Bytes content;
  auto view = load_record(file, kMagic.size(), **head, limits, content);
  if (!view) return error_of(view);
  auto header = parse<Header>(*view);
  if (!header) return file.named(header.error());
  return FileBegin{std::move(*header), kMagic.size() + kRecordHead + (*head)->length};
}

}  // namespace orbwatch::hal::mcap
