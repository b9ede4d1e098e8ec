// SPDX-License-Identifier: Apache-2.0
#include "hal/mcap/record.h"

namespace orbwatch::hal::mcap {

std::string name_of(Opcode opcode) {
  static constexpr std::array<std::string_view, 15> kNames{
      "header",     "footer",        "schema",         "channel",        "message",
      "chunk",      "message index", "chunk index",    "attachment",     "attachment index",
      "statistics", "metadata",      "metadata index", "summary offset", "data end"};
  const auto code = static_cast<std::size_t>(opcode);
  if (code == 0 || code > kNames.size()) return "record " + std::to_string(code);
  return std::string(kNames[code - 1]);
}

std::string place_of(Opcode opcode, std::uint64_t offset) {
  return name_of(opcode) + " at byte " + std::to_string(offset);
}

}  // namespace orbwatch::hal::mcap
