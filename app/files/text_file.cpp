// SPDX-License-Identifier: Apache-2.0
#include "app/files/text_file.h"

#include <zlib.h>

#include "hal/regular_file.h"

namespace orbwatch::app {
Result<std::string> TextFiles::read(const std::filesystem::path& file, const std::string& kind) {
  const auto known = instead_.find(file);
  auto text = known == instead_.end() ? hal::read_regular_file(file) : known->second;
  if (!text) return fail(text.error().message + "; it must be " + kind);
  add(*text);
  texts_[file] = *text;
  return text;
}

void TextFiles::add(const std::string& text) {
  checksum_ = static_cast<std::uint32_t>(
      crc32_z(checksum_, reinterpret_cast<const Bytef*>(text.data()), text.size()));
}

}  // namespace orbwatch::app
