// SPDX-License-Identifier: Apache-2.0
#include "hal/mcap/attachment.h"

#include "hal/mcap/crc32.h"

namespace orbwatch::hal::mcap {

void append_attachment(Bytes& out, const Attachment& attachment) {
  const std::size_t content = out.size() + kRecordHead;
  const AttachmentHead head{attachment.log_time, attachment.create_time, attachment.name,
                            attachment.media_type, attachment.data.size()};
  append_record(out, head, attachment.data.size() + sizeof(std::uint32_t));
  out.insert(out.end(), attachment.data.begin(), attachment.data.end());
  const std::uint32_t crc = crc32_of(std::span(out).subspan(content));
  FieldWriter fields(out);
  fields(crc);
}

FileResult<AttachmentHead> parse_attachment(const RecordView& view,
                                            std::span<const std::byte>& data) {
  std::span<const std::byte> rest;
  auto head = parse<AttachmentHead>(view, &rest);
  if (!head) return head;
  const std::string place = place_of(view.opcode, view.offset);
  std::uint32_t stated = 0;
  if (rest.size() < sizeof(stated) || head->data_size != rest.size() - sizeof(stated)) {
    return refuse(place + ": data of " + std::to_string(head->data_size) +
                  " bytes and its CRC, but the record has " + std::to_string(rest.size()));
  }
  FieldReader fields(rest.last(sizeof(stated)));
  fields(stated);
  const std::uint32_t crc = crc32_of(view.content.first(view.content.size() - sizeof(stated)));
  data = rest.first(rest.size() - sizeof(stated));
  if (stated == 0 || stated == crc) return head;
  return refuse(place + ": its CRC is " + std::to_string(crc) + ", the record states " +
                std::to_string(stated));
}

}  // namespace orbwatch::hal::mcap
