// SPDX-License-Identifier: Apache-2.0
#include "app/health/system_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <limits>
#include <sstream>
#include <system_error>

#include "hal/thread/file_descriptor.h"

namespace orbwatch::app {
namespace fs = std::filesystem;

std::optional<std::string> read_system_file(const fs::path& file, std::size_t most) {
  const hal::FileDescriptor in(::open(file.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC));
  if (!in.is_open()) return std::nullopt;
  std::string text(most, '\0');
  std::size_t size = 0;
  while (size < text.size()) {
    const ssize_t got = ::read(in.get(), text.data() + size, text.size() - size);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return std::nullopt;
    if (got == 0) break;
    size += static_cast<std::size_t>(got);
  }
  text.resize(size);
  return text;
}

std::optional<std::int64_t> to_integer(std::string_view text, int base) {
  constexpr std::string_view kSpace = " \t\n";
  const std::size_t first = text.find_first_not_of(kSpace);
  if (first == std::string_view::npos) return std::nullopt;
  text = text.substr(first, text.find_last_not_of(kSpace) - first + 1);
  if (base == 16 && text.starts_with("0x")) text.remove_prefix(2);
  std::int64_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number, base);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return number;
}

std::optional<std::int64_t> read_integer(const fs::path& file, int base) {
  const auto text = read_system_file(file);
  return text ? to_integer(*text, base) : std::nullopt;
}

std::optional<std::uint64_t> memory_line(const fs::path& file, std::string_view key) {
  std::istringstream lines(read_system_file(file).value_or(""));
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with(key) || !line.ends_with(" kB")) continue;
    const std::string_view number = std::string_view(line).substr(key.size());
    const auto kibibytes = to_integer(number.substr(0, number.size() - 3));
    constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max() / 1024;
    if (!kibibytes || *kibibytes < 0 || *kibibytes > kMost) return std::nullopt;
    return static_cast<std::uint64_t>(*kibibytes) * 1024;
  }
  return std::nullopt;
}

std::vector<fs::path> entries(const fs::path& folder) {
  std::vector<fs::path> found;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    found.push_back(entry->path());
  }
  return found;
}

std::vector<fs::path> entries(const fs::path& folder, std::string_view prefix) {
  std::vector<fs::path> found = entries(folder);
  std::erase_if(found, [prefix](const fs::path& path) {
    return !path.filename().native().starts_with(prefix);
  });
  return found;
}

}  // namespace orbwatch::app
