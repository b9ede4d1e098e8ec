#include "app/files/text_file.h"

#include <zlib.h>

#include <fstream>

namespace orbwatch::app {
namespace {

Result<std::string> read_text(const std::filesystem::path& file, const std::string& kind) {
  constexpr std::size_t kMost = 1 << 20;
  std::ifstream in(file, std::ios::binary);
  std::string text(kMost + 1, '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  // At the end of the file the stream fails and has eof; a file that cannot be opened, or a folder,
  // fails without.
  if (!in.eof() && !in.good()) {
    return fail(file.string() + ": cannot be read; it must be " + kind);
  }
  text.resize(static_cast<std::size_t>(in.gcount()));
  if (text.size() > kMost) {
    return fail(file.string() + ": is larger than 1 MiB; it must be " + kind);
  }
  return text;
}

}  // namespace

Result<std::string> TextFiles::read(const std::filesystem::path& file, const std::string& kind) {
  const auto known = instead_.find(file);
  auto text = known == instead_.end() ? read_text(file, kind) : known->second;
  if (!text) return text;
  add(*text);
  texts_[file] = *text;
  return text;
}

void TextFiles::add(const std::string& text) {
  checksum_ = static_cast<std::uint32_t>(
      crc32_z(checksum_, reinterpret_cast<const Bytef*>(text.data()), text.size()));
}

}  // namespace orbwatch::app
