#include "app/config/text_file.h"

#include <fstream>

namespace orbwatch::app {

Result<std::string> read_text_file(const std::filesystem::path& file, const std::string& kind) {
  constexpr std::size_t kMost = 1 << 20;
  std::ifstream in(file, std::ios::binary);
  std::string text(kMost + 1, '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  // Reading to the end fails in the stream's terms; a file that cannot be opened, or a folder,
  // never gets to its end.
  if (!in.eof() && !in.good()) {
    return fail(file.string() + ": cannot be read; it must be " + kind);
  }
  text.resize(static_cast<std::size_t>(in.gcount()));
  if (text.size() > kMost) {
    return fail(file.string() + ": is larger than 1 MiB; it must be " + kind);
  }
  return text;
}

}  // namespace orbwatch::app
