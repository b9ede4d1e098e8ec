// SPDX-License-Identifier: Apache-2.0
#include "app/files/text/text_file.h"

#include <zlib.h>

#include "hal/regular_file.h"

namespace orbwatch::app::files {

std::uint32_t checksum_of(const std::string& text, std::uint32_t before) {
  return static_cast<std::uint32_t>(
      crc32_z(before, reinterpret_cast<const Bytef*>(text.data()), text.size()));
}

Result<std::string> TextFiles::read(const std::filesystem::path& file, const std::string& kind) {
  const auto known = instead_.find(file);
  auto text = known == instead_.end() ? hal::read_regular_file(file) : known->second;
  if (!text) return fail(text.error().message + "; it must be " + kind);
  add(*text);
  texts_[file] = *text;
  return text;
}

}  // namespace orbwatch::app::files
